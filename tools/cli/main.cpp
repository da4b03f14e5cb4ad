// The program `slicelens`: parses the command line, runs one command, turns errors into one line and an exit
// status (0 done, 1 the work failed, 2 wrong usage or scene).

#include "console.h"
#include "core/errors.h"
#include "core/text.h"
#include "memory.h"
#include "options.h"

#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>
#include <new>

namespace slicelens::cli {

namespace {

void add_set(CLI::App& command, std::vector<std::string>& set, const std::string& name = "--set",
             const std::string& help = "") {
  command
      .add_option(name, set,
                  help.empty() ? "change a scene key, for instance render.spacing=0.5; may be given again "
                                 "(see: slicelens list keys)"
                               : help)
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
}

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

void add_info(CLI::App& app, InfoOptions& options, std::function<void()>& run) {
  CLI::App& command = *app.add_subcommand("info", "what a volume file holds");
  command.footer("Reads NRRD, MetaImage, NIfTI, DICOM (a folder or one file of a series), VTK image data, "
                 "stacks of PNG, TIFF or JPEG\n"
                 "(a folder or a pattern), and headerless raw files: name_256x256x256_uint8.raw, or --set "
                 "volume.size=[…] --set volume.type=….");
  command.add_option("volume", options.input, "file, folder or pattern")->required()->type_name("");
  add_set(command, options.set);
  command.add_flag(
      "--json", options.json,
      "as JSON: dims, spacing, origin, direction, type, range, mean, components, frames, format");
  command.callback([&options, &run] { run = [&options] { run_info(options); }; });
}

void add_phantom(CLI::App& app, PhantomOptions& options, std::function<void()>& run) {
  CLI::App& command = *app.add_subcommand("phantom", "write an embedded phantom as a volume file");
  command.footer("  slicelens phantom head --size 128 -o head.nrrd");
  command.add_option("name", options.name, "see: slicelens list phantoms")->required()->type_name("");
  command.add_option("-o,--output", options.output, "volume to write: .nrrd, .mha or .mhd")
      ->required()
      ->type_name("FILE");
  command.add_option("--size", options.size, "voxels: one number for a cube, or three")
      ->expected(1, 3)
      ->check(CLI::Range(1, 16384))
      ->type_name("N");
  command.callback([&options, &run] { run = [&options] { run_phantom(options); }; });
}

void add_list(CLI::App& app, ListOptions& options, std::function<void()>& run) {
  CLI::App& command = *app.add_subcommand("list", "what this program knows");
  command
      .add_option("what", options.what,
                  "contexts, figures, keys, labels, lens-keys, phantoms, pipelines, presets or warps")
      ->type_name("");
  command.callback([&options, &run] { run = [&options] { run_list(options); }; });
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

void add_plot(CLI::App& app, PlotOptions& options, std::function<void()>& run) {
  CLI::App& command = *app.add_subcommand(
      "plot", "draw a scene's per-axis tables: offset, mask, attenuation and highlight as curves");
  command.footer(
      "Each column is an axis of the volume, each row one channel of its table; the last row shows "
      "the texels themselves.\nThe plots are drawn by gnuplot (apt-get install gnuplot-nox).\n\n"
      "  slicelens plot bifocal.json -o tables.svg\n"
      "  slicelens plot bifocal.json -o tables.png --set volume.size=[64,64,64] --size 1600,1600");
  command.add_option("input", options.input, "SCENE, or an IMAGE that slicelens wrote")
      ->required()
      ->type_name("");
  command.add_option("-o,--output", options.output, "page to write, .svg or .png")
      ->required()
      ->type_name("FILE");
  add_set(command, options.set);
  command.add_option("--size", options.size, "width and height of the page in pixels; default 1200,1200")
      ->expected(2)
      ->delimiter(',')
      ->check(CLI::Range(200, 8192))
      ->type_name("W,H");
  command.callback([&options, &run] { run = [&options] { run_plot(options); }; });
}

void add_warp(CLI::App& app, WarpOptions& options, std::function<void()>& run) {
  CLI::App& command = *app.add_subcommand(
      "warp", "write the deformed volume as a volume of its own, lying where the picture shows it");
  command.footer("Samples by render.filter in double precision. Clipping, effects and colours stay with the "
                 "scene.\n\n"
                 "  slicelens warp landmarks.json -o deformed.nrrd\n"
                 "  slicelens warp landmarks.json -o small.mha --size 64,64,64 --float");
  command.add_option("input", options.input, "SCENE, or an IMAGE that slicelens wrote")
      ->required()
      ->type_name("");
  command.add_option("-o,--output", options.output, "volume to write, .nrrd, .nhdr, .mha or .mhd")
      ->required()
      ->type_name("FILE");
  command.add_option("--volume", options.volume, "of several volumes, which one is baked, from 0")
      ->check(CLI::Range(0, 3))
      ->type_name("I");
  add_set(command, options.set);
  command
      .add_option("--size", options.size,
                  "voxels on each axis; default: the volume's, and more where it sticks out of its box")
      ->expected(3)
      ->delimiter(',')
      ->check(CLI::Range(1, 16384))
      ->type_name("X,Y,Z");
  command.add_flag("--float", options.as_float, "write float32 instead of rounding to the volume's type");
  command.add_option("--outside", options.outside, "value where nothing is shown; default: the smallest")
      ->type_name("VALUE");
  command.add_flag("--compress", options.compress, "compress the voxels");
  command.callback([&options, &run] { run = [&options] { run_warp(options); }; });
}

void add_pick(CLI::App& app, PickOptions& options, std::function<void()>& run) {
  CLI::App& command = *app.add_subcommand(
      "pick", "what lies under a pixel of the displayed volume: three hits as JSON on stdout");
  command.footer("Samples the line of sight through the (deformed) volume and gives the first sample with "
                 "opacity (alpha), the "
                 "first with a\nlarge gradient (gradient, see the key pick.gradient), and the one at which "
                 "the summed opacity "
                 "reaches one (accumulated):\nin view, world, object (displayed) and texture (data) space; "
                 "null where there is "
                 "none.\n\n"
                 "  slicelens pick head.json --at 256,200\n"
                 "  slicelens pick head.json --at 256,200 --profile ray.csv");
  command.add_option("input", options.input, "SCENE, VOLUME or IMAGE")->required()->type_name("");
  command.add_option("--at", options.at, "X,Y in pixels of the picture, (0,0) the top left corner")
      ->required()
      ->delimiter(',')
      ->expected(2)
      ->type_name("X,Y");
  command.add_option("--samples", options.samples, "on the line (default: four for each slice distance)")
      ->check(CLI::Range(2, 16384))
      ->type_name("N");
  command.add_option("--volume", options.volume, "of several volumes, which one is looked at, from 0")
      ->check(CLI::Range(0, 3))
      ->type_name("I");
  command.add_option("--profile", options.profile, "write all samples as CSV")->type_name("FILE");
  add_set(command, options.set);
  command.callback([&options, &run] { run = [&options] { run_pick(options); }; });
}

void add_slice(CLI::App& app, SliceOptions& options, std::function<void()>& run) {
  CLI::App& command =
      *app.add_subcommand("slice", "a picture of one plane through the displayed (deformed) volume");
  command.footer("Looks at the plane from the side its normal points to. The key planes puts such planes "
                 "into a scene.\n\n"
                 "  slicelens slice head.json --point 0.5,0.5,0.5 --normal 0,-1,0 -o coronal.png\n"
                 "  slicelens slice ct/ --normal 1,0,0.3 --range -200,400 -o oblique.png");
  command.add_option("input", options.input, "SCENE, VOLUME or IMAGE")->required()->type_name("");
  command.add_option("-o,--output", options.output, "picture to write, .png or .exr")
      ->required()
      ->type_name("FILE");
  command
      .add_option("--point", options.point, "X,Y,Z of the plane, texture coordinates (default 0.5,0.5,0.5)")
      ->delimiter(',')
      ->expected(3)
      ->type_name("X,Y,Z");
  command.add_option("--normal", options.normal, "X,Y,Z, world vector (default 0,-1,0: from the front)")
      ->delimiter(',')
      ->expected(3)
      ->type_name("X,Y,Z");
  command.add_option("--style", options.style, "values (grey) or transfer (the transfer function's colours)")
      ->capture_default_str()
      ->type_name("STYLE");
  command.add_option("--range", options.range, "BLACK,WHITE in data units (default: the data's range)")
      ->delimiter(',')
      ->expected(2)
      ->type_name("B,W");
  command.add_option("--volume", options.volume, "of several volumes, which one is cut, from 0")
      ->check(CLI::Range(0, 3))
      ->type_name("I");
  add_set(command, options.set);
  command
      .add_option("--depth", options.depth,
                  "8 or 16 for .png (default 8), half or float for .exr (default float)")
      ->type_name("DEPTH");
  command.callback([&options, &run] { run = [&options] { run_slice(options); }; });
}

void add_transfer(CLI::App& app, TransferOptions& options, std::function<void()>& run) {
  CLI::App& command = *app.add_subcommand(
      "transfer", "write a transfer function in the format of another program, or show it as a scene's keys");
  command.footer("Writes ParaView colour maps (.json), 3D Slicer volume properties (.vp, .vp.json) and "
                 "ImageVis3D tables (.1dt), and says\nwhat the format could not hold. Without -o the keys of "
                 "the section transfer go to stdout. Files are read by scenes\nthrough transfer.file.\n\n"
                 "  slicelens transfer CT-Bone -o bone.vp.json\n"
                 "  slicelens transfer head.json -o head.1dt --rows 4096\n"
                 "  slicelens transfer ColorMaps.json --map 'Cool to Warm' --range -200,400");
  command
      .add_option("input", options.input,
                  "PRESET, file (.json, .xml, .vp, .vp.json, .1dt), SCENE, VOLUME or IMAGE")
      ->required()
      ->type_name("");
  command.add_option("-o,--output", options.output, "file to write, .json, .vp, .vp.json or .1dt")
      ->type_name("FILE");
  command.add_option("--map", options.map, "name of the colour map in a ParaView file that holds several")
      ->type_name("NAME");
  command
      .add_option("--volume", options.volume, "of several volumes of a scene, whose function it is, from 0")
      ->check(CLI::Range(0, 3))
      ->type_name("I");
  command
      .add_option("--range", options.range,
                  "data values of the first and the last point of a file, relative preset or written table")
      ->delimiter(',')
      ->expected(2)
      ->type_name("LOW,HIGH");
  command.add_option("--rows", options.rows, "of a table (.1dt)")
      ->capture_default_str()
      ->check(CLI::Range(2, 16384))
      ->type_name("N");
  add_set(command, options.set);
  command.callback([&options, &run] { run = [&options] { run_transfer(options); }; });
}

void add_camera(CLI::App& app, CameraOptions& options, std::function<void()>& run) {
  CLI::App& command = *app.add_subcommand(
      "camera", "write a scene's camera as a ParaView camera, or show it as explicit keys");
  command.footer("Without -o the keys of the section camera go to stdout, with positions instead of angles. "
                 "Scenes read such files\nthrough camera.file.\n\n"
                 "  slicelens camera head.json -o head.pvcc");
  command.add_option("input", options.input, "SCENE, VOLUME or IMAGE")->required()->type_name("");
  command.add_option("-o,--output", options.output, "file to write, .pvcc")->type_name("FILE");
  add_set(command, options.set);
  command.callback([&options, &run] { run = [&options] { run_camera(options); }; });
}

void add_export(CLI::App& app, ExportOptions& options, std::function<void()>& run) {
  CLI::App& command =
      *app.add_subcommand("export", "write a scene for other renderers: numbers and raw voxels");
  command.footer(
      "Writes DIR/scene.json with everything worked out (transfer function, camera, sample distance in "
      "world units, light)\nand DIR/volume.raw. tools/render_with_vtk draws such folders with VTK. "
      "Refused are warps, several volumes,\nlabels, clipping, effects and overlays.\n\n"
      "  slicelens export head.json -o head/ --set render.spacing=0.5");
  command.add_option("input", options.input, "SCENE, VOLUME or IMAGE")->required()->type_name("");
  command.add_option("-o,--output", options.folder, "folder to write to; made where there is none")
      ->required()
      ->type_name("DIR");
  add_set(command, options.set);
  command.callback([&options, &run] { run = [&options] { run_export(options); }; });
}

void add_study(CLI::App& app, StudyOptions& options, std::function<void()>& run) {
  CLI::App& command = *app.add_subcommand(
      "study", "measure quality and time of every combination that a study file names, and report them");
  command.footer(
      "Writes results.csv, results.json, report.html and the pictures into DIR, and keeps every measurement "
      "in "
      "journal.jsonl:\ncalled again, an interrupted study goes on where it was. A combination that fails is "
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
                 "Markdown files "
                 "(docs/studies.md)\nand names the files that changed.\n\n"
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

/// An error's text as one line on stderr.
int fail(const std::string& message, int status) {
  end_progress();
  std::string line = message;
  for (char& c : line) {
    if (c == '\n' || c == '\r')
      c = ' ';
  }
  std::fprintf(stderr, "slicelens: %s\n", line.c_str());
  return status;
}

/// What was printed must have arrived: a full disk or a closed stdout is a failure.
int end_output(bool good) {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !good)
    return fail("stdout: cannot be written", 1);
  return 0;
}

/// Where a standard stream is closed its number would go to the next file opened, and a warning would end up
/// in a picture. Opened for reading, so that writing to a closed stdout still fails.
void fill_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) == -1 && ::open("/dev/null", O_RDONLY) != stream)
      std::_Exit(1);
  }
}

/// CLI11 would only say that a command is missing.
void refuse_unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-')
    return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  const std::string word = argv[1];
  if (std::find(names.begin(), names.end(), word) != names.end())
    return;
  const auto nearest = nearest_word(word, names);
  throw UsageError("there is no command '" + word + "'; " +
                   (nearest ? "did you mean " + *nearest + "?" : "give one of " + join(names)));
}

int run_program(int argc, char** argv) {
  CLI::App app("Slicelens renders volumes by texture slicing and by ray casting, and measures how far the "
               "two are apart.",
               "slicelens");
  app.set_version_flag("--version", std::string("slicelens ") + SLICELENS_VERSION);
  app.require_subcommand(1);
  app.footer("Exit status: 0 done, 1 the work failed, 2 wrong usage or scene. Help for one command: "
             "slicelens render --help");
  std::function<void()> run;
  RenderOptions render;
  LensOptions lens;
  CompareOptions compare;
  InfoOptions info;
  PhantomOptions phantom;
  ListOptions list;
  GalleryOptions gallery;
  AnimateOptions animate;
  PlotOptions plot;
  WarpOptions warp;
  PickOptions pick;
  SliceOptions slice;
  TransferOptions transfer;
  CameraOptions camera;
  ExportOptions exporting;
  StudyOptions study;
  TablesOptions tables;
  add_render(app, render, run);
  add_lens(app, lens, run);
  add_compare(app, compare, run);
  add_info(app, info, run);
  add_phantom(app, phantom, run);
  add_list(app, list, run);
  add_gallery(app, gallery, run);
  add_animate(app, animate, run);
  add_plot(app, plot, run);
  add_warp(app, warp, run);
  add_pick(app, pick, run);
  add_slice(app, slice, run);
  add_transfer(app, transfer, run);
  add_camera(app, camera, run);
  add_export(app, exporting, run);
  add_study(app, study, run);
  add_tables(app, tables, run);
  try {
    refuse_unknown_command(app, argc, argv);
    app.parse(argc, argv);
    run();
  } catch (const CLI::Success& e) { // --help or --version
    app.exit(e);
    std::cout.flush();
    return end_output(std::cout.good());
  } catch (const CLI::ParseError& e) {
    const auto commands = app.get_subcommands();
    const std::string command = commands.empty() ? "slicelens" : "slicelens " + commands.front()->get_name();
    return fail(std::string(e.what()) + "; see " + command + " --help", 2);
  }
  return end_output(true);
}

} // namespace

} // namespace slicelens::cli

int main(int argc, char** argv) {
  using namespace slicelens;
  cli::fill_closed_streams();
  keep_freed_memory();
  try {
    return cli::run_program(argc, argv);
  } catch (const UsageError& error) {
    return cli::fail(error.what(), 2);
  } catch (const Error& error) {
    return cli::fail(error.what(), 1);
  } catch (const std::bad_alloc&) {
    return cli::fail("out of memory; use a smaller volume or picture", 1);
  } catch (const std::exception& error) {
    return cli::fail(std::string("unexpected error: ") + error.what(), 1);
  }
}
