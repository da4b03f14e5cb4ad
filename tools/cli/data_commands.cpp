#include "commands.h"

namespace slicelens::cli {

namespace {

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
  command.footer(
      "  slicelens phantom head --size 128 -o head.nrrd\n"
      "  slicelens phantom head --size 2048 2048 1024 -o big.nrrd     16 bits, 8 GiB, made row by row");
  command.add_option("name", options.name, "see: slicelens list phantoms")->required()->type_name("");
  command.add_option("-o,--output", options.output, "volume to write: .nrrd, .nhdr, .mha or .mhd")
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

} // namespace

void add_data_commands(CLI::App& app, AllOptions& options, std::function<void()>& run) {
  add_info(app, options.info, run);
  add_phantom(app, options.phantom, run);
  add_list(app, options.list, run);
  add_plot(app, options.plot, run);
  add_warp(app, options.warp, run);
  add_pick(app, options.pick, run);
  add_slice(app, options.slice, run);
  add_transfer(app, options.transfer, run);
  add_camera(app, options.camera, run);
  add_export(app, options.exporting, run);
}

} // namespace slicelens::cli
