// What the command line asks for, as plain values. main.cpp fills them; each command takes one.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace slicelens::cli {

struct RenderOptions {
  std::string input;
  std::string output;
  std::vector<std::string> set;
  std::string depth; ///< "8", "16", "half", "float" or empty
  bool print_scene = false;
  bool verbose = false;
};

struct LensOptions {
  std::string input; ///< picture, 2D scene, "checkerboard" or "testcard"
  std::string output;
  std::vector<std::string> set;
  std::string depth; ///< as in RenderOptions
  bool wireframe = false;
  bool outline = false;
  std::optional<std::size_t> lattice;
  bool magnification = false;
  bool print_scene = false;
  bool verbose = false;
};

struct CompareOptions {
  std::string a;
  std::string b; ///< empty: a again
  std::string folder;
  std::vector<std::string> set;
  std::vector<std::string> set_a;
  std::vector<std::string> set_b;
  double factor = 8;
  bool verbose = false;
};

struct InfoOptions {
  std::string input;
  std::vector<std::string> set;
  bool json = false;
};

struct PhantomOptions {
  std::string name;
  std::string output;
  std::vector<std::size_t> size;
  bool compress = false;
};

struct ListOptions {
  std::string what;
};

struct GalleryOptions {
  std::vector<std::string> inputs; ///< scenes or volumes; empty: the embedded gallery
  std::string folder = "out/gallery";
  std::vector<std::string> set;
};

struct AnimateOptions {
  std::string input;
  std::string output; ///< .mp4, .gif or a folder
  std::vector<std::string> set;
  std::vector<std::string> vary; ///< KEY=FROM:TO
  std::size_t frames = 0;
  double fps = 25;
  bool loop = false;
};

struct WarpOptions {
  std::string input;
  int volume = 0;     ///< of several, which one is baked
  std::string output; ///< .nrrd, .nhdr, .mha or .mhd
  std::vector<std::string> set;
  std::vector<std::size_t> size; ///< voxels; empty: the volume's own
  bool as_float = false;
  std::optional<double> outside;
  bool compress = false;
};

struct PlotOptions {
  std::string input;
  std::string output; ///< .svg or .png
  std::vector<std::string> set;
  std::vector<int> size; ///< width and height in pixels; empty: the page's own
};

struct PickOptions {
  std::string input;
  std::vector<double> at;     ///< x, y in pixels
  std::optional<int> samples; ///< none: as many as the slices deserve
  int volume = 0;             ///< of several, which one is looked at
  std::string profile;        ///< CSV file; empty: none
  std::vector<std::string> set;
};

struct SliceOptions {
  std::string input;
  int volume = 0; ///< of several, which one is cut
  std::string output;
  std::vector<double> point;  ///< texture coordinates of the displayed volume
  std::vector<double> normal; ///< world
  std::string style = "values";
  std::vector<double> range; ///< of the grey; empty: the data's
  std::vector<std::string> set;
  std::string depth; ///< as in RenderOptions
};

struct TransferOptions {
  std::string input;  ///< preset, file of another program, scene, volume or picture
  std::string output; ///< .json, .vp, .vp.json or .1dt; empty: the section of a scene on stdout
  std::string map;    ///< of a file that holds several
  int volume = 0;     ///< of a scene's several, whose function it is
  std::vector<double> range;
  std::size_t rows = 256; ///< of .1dt
  std::vector<std::string> set;
};

struct CameraOptions {
  std::string input;
  std::string output; ///< .pvcc; empty: the section of a scene on stdout
  std::vector<std::string> set;
};

struct ExportOptions {
  std::string input;
  std::string folder;
  std::vector<std::string> set;
};

struct StudyOptions {
  std::string input;
  std::string output; ///< folder; empty: the study's name
  std::vector<std::string> set;
  bool quick = false;
  bool fresh = false;
  std::string shard;              ///< "i/n"; empty: all
  std::vector<std::string> merge; ///< folders of shards
};

struct TablesOptions {
  std::vector<std::string> documents;
  std::string results; ///< folder with a folder for each study
  bool check = false;
};

// Each runs one command and returns; results go to stdout and files, the rest to stderr. They throw the
// errors of core/errors.h.
void run_render(const RenderOptions& options);
void run_lens(const LensOptions& options);
void run_compare(const CompareOptions& options);
void run_info(const InfoOptions& options);
void run_phantom(const PhantomOptions& options);
void run_list(const ListOptions& options);
void run_gallery(const GalleryOptions& options);
void run_animate(const AnimateOptions& options);
void run_plot(const PlotOptions& options);
void run_warp(const WarpOptions& options);
void run_pick(const PickOptions& options);
void run_slice(const SliceOptions& options);
void run_transfer(const TransferOptions& options);
void run_camera(const CameraOptions& options);
void run_export(const ExportOptions& options);
void run_study_command(const StudyOptions& options);
void run_tables(const TablesOptions& options);

} // namespace slicelens::cli
