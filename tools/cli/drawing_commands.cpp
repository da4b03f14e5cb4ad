#include "commands.h"

namespace slicelens::cli {

void add_set(CLI::App& command, std::vector<std::string>& set, const std::string& name,
             const std::string& help) {
  command
      .add_option(name, set,
                  help.empty() ? "change a scene key, for instance render.spacing=0.5; may be given again "
                                 "(see: slicelens list keys)"
                               : help)
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
}

namespace {

void add_render(CLI::App& app, RenderOptions& options, std::function<void()>& run) {
  CLI::App& command =
      *app.add_subcommand("render", "render a scene, a volume, or a picture that slicelens wrote");
  command.footer("A SCENE is a JSON file, a VOLUME any file or folder that 'slicelens info' can read, an "
                 "IMAGE a picture written by\n"
                 "slicelens, which holds its scene and is rendered again from it.\n\n"
                 "  slicelens render head.json -o head.png --set render.spacing=0.5\n"
                 "  slicelens render ct/ --set transfer.preset=CT-Bone --set camera.azimuth=30 -o bone.png");
  command.add_option("input", options.input, "SCENE, VOLUME or IMAGE")->required()->type_name("");
  command
      .add_option("-o,--output", options.output,
                  "picture to write, .png or .exr; default: the input's name as .png in the current folder")
      ->type_name("FILE");
  add_set(command, options.set);
  command
      .add_option("--depth", options.depth,
                  "8 or 16 for .png (default 8), half or float for .exr (default float)")
      ->type_name("DEPTH");
  command.add_flag("--print-scene", options.print_scene,
                   "print the scene with every default filled in, and do nothing else");
  command.add_flag("-v,--verbose", options.verbose,
                   "say on stderr what was rendered by what, and where the time went");
  command.callback([&options, &run] { run = [&options] { run_render(options); }; });
}

void add_lens(CLI::App& app, LensOptions& options, std::function<void()>& run) {
  CLI::App& command = *app.add_subcommand(
      "lens", "put LaMar's magnification lens on a picture, a checkerboard or a test card");
  command.footer(
      "A SCENE is a JSON file with a section image; an IMAGE that this command wrote is drawn again from its "
      "scene.\nPositions are fractions of the image from its top left corner, lengths fractions of its "
      "longer edge.\n\n"
      "  slicelens lens photo.jpg -o lens.png --set warp.center=[0.3,0.6] --set warp.zoom=3\n"
      "  slicelens lens checkerboard -o grid.png --set warp.border=linear --wireframe --outline\n"
      "  slicelens list lens-keys");
  command.add_option("input", options.input, "IMAGE, SCENE, checkerboard or testcard")
      ->required()
      ->type_name("");
  command.add_option("-o,--output", options.output, "picture to write, .png or .exr")
      ->required()
      ->type_name("FILE");
  add_set(command, options.set, "--set",
          "change a key of the 2D scene, for instance warp.zoom=3; may be given again (see: slicelens list "
          "lens-keys)");
  command.add_flag("--wireframe", options.wireframe, "draw the edges of the segments");
  command.add_flag("--outline", options.outline, "draw the inner and the outer edge of each lens");
  command.add_option("--lattice", options.lattice, "draw a regular lattice carried through the lens")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  command.add_flag("--magnification", options.magnification,
                   "show the local magnification in false colours, with a bar");
  command
      .add_option("--depth", options.depth,
                  "8 or 16 for .png (default 8), half or float for .exr (default float)")
      ->type_name("DEPTH");
  command.add_flag("--print-scene", options.print_scene,
                   "print the scene with every default filled in, and do nothing else");
  command.add_flag("-v,--verbose", options.verbose, "say on stderr what was drawn by what");
  command.callback([&options, &run] { run = [&options] { run_lens(options); }; });
}

void add_compare(CLI::App& app, CompareOptions& options, std::function<void()>& run) {
  CLI::App& command =
      *app.add_subcommand("compare", "compare two pictures or scenes; metrics as JSON on stdout");
  command.footer(
      "  slicelens compare a.png b.png -o difference/\n"
      "  slicelens compare head.json --set-a render.pipeline=slices --set-b render.pipeline=rays\n\n"
      "psnr (dB, null when equal) and the other metrics are over RGB on the background; psnr_covered is over "
      "the pixels that\n"
      "either picture covers; over_1_255 is the fraction of values that differ by more than 1/255; ssim and "
      "ms_ssim (null below\n"
      "176 pixels) are of the luma; flip is the mean FLIP error, 67 pixels per degree. docs/metrics.md "
      "explains "
      "them.");
  command.add_option("a", options.a, "first picture, scene or volume")->required()->type_name("");
  command.add_option("b", options.b, "second one; default: the first again, with --set-a and --set-b")
      ->type_name("");
  command
      .add_option("-o,--output", options.folder,
                  "folder for both pictures, the amplified difference, a heat map and FLIP's error map")
      ->type_name("DIR");
  add_set(command, options.set, "--set", "change a scene key on both sides");
  add_set(command, options.set_a, "--set-a", "change a scene key of the first side");
  add_set(command, options.set_b, "--set-b", "change a scene key of the second side");
  command
      .add_option("--factor", options.factor,
                  "amplification of the difference picture; the heat map ends at its inverse")
      ->capture_default_str()
      ->check(CLI::Range(1e-6, 1e6))
      ->type_name("F");
  command.add_flag("-v,--verbose", options.verbose, "say on stderr what was rendered by what");
  command.callback([&options, &run] { run = [&options] { run_compare(options); }; });
}

void add_gallery(CLI::App& app, GalleryOptions& options, std::function<void()>& run) {
  CLI::App& command = *app.add_subcommand(
      "gallery", "render scenes by slices and by rays into a page with pictures and metrics");
  command.add_option("inputs", options.inputs, "scenes or volumes; none: the embedded gallery of phantoms")
      ->type_name("");
  command.add_option("-o,--output", options.folder, "folder for index.html and the pictures")
      ->capture_default_str()
      ->type_name("DIR");
  add_set(command, options.set);
  command.callback([&options, &run] { run = [&options] { run_gallery(options); }; });
}

void add_animate(CLI::App& app, AnimateOptions& options, std::function<void()>& run) {
  CLI::App& command = *app.add_subcommand(
      "animate", "render a scene many times while keys of it change: a video or pictures");
  command.footer(
      "Every key of numbers can vary, lists of them too; it goes from FROM in the first frame to TO in the "
      "last.\nThe frames are pictures of their own, in the folder OUT.frames of a video OUT, and stay there. "
      "Called again, the command\nrenders only those that are missing or show another scene, so work that "
      "was interrupted goes on. Videos need ffmpeg\n(apt-get install ffmpeg).\n\n"
      "  slicelens animate head.json --vary camera.azimuth=0:360 --loop --frames 100 -o turn.mp4\n"
      "  slicelens animate lens.json --vary warp.zoom=1:3 --vary warp.center=[0.3,0.5,0.5]:[0.7,0.5,0.5] "
      "--frames 50 -o lens.gif\n"
      "  slicelens animate head.json --vary render.spacing=4:0.5 --frames 8 -o spacing/");
  command.add_option("input", options.input, "SCENE, VOLUME or IMAGE")->required()->type_name("");
  command
      .add_option("-o,--output", options.output,
                  "video to write, .mp4 or .gif, or a folder (with / at its end) for .png frames")
      ->required()
      ->type_name("OUT");
  command
      .add_option("--vary", options.vary,
                  "a scene key and its values in the first and in the last frame; may be given again")
      ->required()
      ->type_name("KEY=FROM:TO")
      ->expected(1)
      ->take_all();
  command.add_option("--frames", options.frames, "how many, 1 to 100000")
      ->required()
      ->check(CLI::Range(1, 100000))
      ->type_name("N");
  command.add_flag("--loop", options.loop,
                   "a closed loop: the frame after the last would be the first, at TO as at FROM");
  command.add_option("--fps", options.fps, "frames a second of a video, 0.1 to 240 (a .gif: to 50)")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 240.0))
      ->type_name("F");
  add_set(command, options.set);
  command.callback([&options, &run] { run = [&options] { run_animate(options); }; });
}

void add_study(CLI::App& app, StudyOptions& options, std::function<void()>& run) {
  CLI::App& command = *app.add_subcommand(
      "study", "measure quality and time of every combination that a study file names, and report them");
  command.footer(
      "Writes results.csv, results.json, report.html and the pictures into DIR, and keeps every measurement "
      "in journal.jsonl:\ncalled again, an interrupted study goes on where it was. A combination that fails "
      "is "
      "listed and does not stop the others;\nthe exit status is then 1. Shards go into folders of their own "
      "and are joined by --merge.\n\n"
      "  slicelens study studies/lamar-table3.json -o lamar3\n"
      "  slicelens study sweep.json --shard 1/4 -o part1        # on four machines, or by GNU parallel\n"
      "  slicelens study sweep.json --merge part1 --merge part2 --merge part3 --merge part4 -o all");
  command.add_option("input", options.input, "STUDY, a .json file (docs/studies.md)")
      ->required()
      ->type_name("");
  command.add_option("-o,--output", options.output, "folder to write; default: the study's name")
      ->type_name("DIR");
  add_set(command, options.set, "--set",
          "change a scene key of every combination, unless it varies; may be given again");
  command.add_flag("--quick", options.quick, "the study's own short form (its part \"quick\")");
  command.add_flag("--fresh", options.fresh, "put earlier results in DIR aside and measure everything anew");
  command.add_option("--shard", options.shard, "measure the i-th of n parts only")->type_name("i/n");
  command.add_option("--merge", options.merge, "a folder that a shard wrote; may be given again")
      ->type_name("DIR")
      ->expected(1)
      ->take_all();
  command.callback([&options, &run] { run = [&options] { run_study_command(options); }; });
}

void add_tables(CLI::App& app, TablesOptions& options, std::function<void()>& run) {
  CLI::App& command = *app.add_subcommand(
      "tables", "make the tables and numbers of documents anew from the results of studies");
  command.footer("Replaces what stands between the marks <!-- study NAME: COLUMNS --> and <!-- end --> of "
                 "Markdown files (docs/studies.md)\nand names the files that changed.\n\n"
                 "  slicelens tables docs/benchmarks.md --results out/studies");
  command.add_option("documents", options.documents, "Markdown files")->required()->type_name("");
  command
      .add_option("--results", options.results,
                  "folder with a folder for each study, as slicelens study wrote it")
      ->required()
      ->type_name("DIR");
  command.add_flag("--check", options.check, "change nothing; exit status 1 where a document would change");
  command.callback([&options, &run] { run = [&options] { run_tables(options); }; });
}

} // namespace

void add_drawing_commands(CLI::App& app, AllOptions& options, std::function<void()>& run) {
  add_render(app, options.render, run);
  add_lens(app, options.lens, run);
  add_compare(app, options.compare, run);
  add_gallery(app, options.gallery, run);
  add_animate(app, options.animate, run);
  add_study(app, options.study, run);
  add_tables(app, options.tables, run);
}

} // namespace slicelens::cli
