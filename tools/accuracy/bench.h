// What the sections of slicelens_accuracy share: subjects, drawing them under changed settings, differences
// of pictures, and tables.
#pragma once

#include "gl/context.h"
#include "render/render.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace slicelens::accuracy {

/// What is measured against.
struct Bench {
  gl::Context& context;
  std::filesystem::path volumes; ///< folder of real volumes; empty: phantoms only
};

/// A volume with a transfer function and a camera, drawn again and again under other settings.
struct Subject {
  std::string name; ///< as the tables call it
  PreparedScene prepared;
  bool transparent_border = true; ///< nothing visible touches the box
};

/// A scene of `size`² pixels seen obliquely, rgba32f, linear-exact, transparent background.
Scene oblique_scene(int size);

/// A phantom of n³ voxels (`engine`: n×n×n/2).
Subject phantom_subject(const std::string& name, int n, TransferFunction transfer, int size);

/// Opacity rising linearly from 0 at `low` to `top` at `high`, both fractions of the data's range, from brown
/// to ivory.
TransferFunction rising(const Volume& volume, double low, double high, double top);

/// The real volumes that are in the folder, under a transfer function made for each; `name_filter` empty or
/// one name.
std::vector<Subject> real_subjects(const Bench& bench, int size);

using Change = std::function<void(Scene&)>;

/// Draws the subject after `change`, which lasts for this picture only.
RenderResult render_changed(const Bench& bench, Subject& subject, const Change& change);
Image draw(const Bench& bench, Subject& subject, const Change& change);

/// How two pictures on transparent black differ. Values are all four channels.
struct Difference {
  double share = 0;         ///< of all values, those more than `limit` apart
  double share_covered = 0; ///< the same among pixels that either picture covers
  std::size_t pixels = 0;   ///< pixels with such a value
  double largest = 0;
  double psnr = 0;         ///< over RGB on black, peak 1; infinite when equal
  double psnr_covered = 0; ///< over the covered pixels only
};
Difference difference(const Image& a, const Image& b, double limit = 1e-3);

// Cells of tables.
std::string scientific(double value); ///< "1.2e-04"
std::string decibel(double value);    ///< "63.1", "equal" for infinity
std::string percent(double share);    ///< "0.031 %"
std::string fixed(double value, int digits);

/// Prints a Markdown table as it grows.
class Table {
public:
  explicit Table(const std::vector<std::string>& heads);
  void row(const std::vector<std::string>& cells);
  ~Table(); ///< ends it with an empty line
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;
};

/// Prints a bar that the project sets itself with what was measured: "- bar: text: measured (limit …): met".
void bar(const std::string& text, const std::string& measured, const std::string& limit, bool met);

/// One line on stderr.
void say(const std::string& text);

// The sections. Each prints its own heading.
void closed_form_section(const Bench& bench);
void parity_section(const Bench& bench);
void perspective_section(const Bench& bench);
void precision_section(const Bench& bench);
void opacity_section(const Bench& bench);
void vessel_section(const Bench& bench);
void axis_section(const Bench& bench);
void gradient_section(const Bench& bench);
void footprint_section(const Bench& bench);
void grid_section(const Bench& bench);
void preintegrated_section(const Bench& bench);
void mode_section(const Bench& bench);
void filter_section(const Bench& bench);
void skip_section(const Bench& bench);

} // namespace slicelens::accuracy
