// What the commands of the program are called, their options and help texts (CLI11).
#pragma once

#include "options.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace slicelens::cli {

/// The options of every command; only those of the one that is called are filled.
struct AllOptions {
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
};

/// `--set KEY=VALUE`, as often as wanted. `help`: empty for the usual one.
void add_set(CLI::App& command, std::vector<std::string>& set, const std::string& name = "--set",
             const std::string& help = "");

/// Commands that draw and measure: render, lens, compare, gallery, animate, study, tables. The one that is
/// called puts its work into `run`; `options` and `run` must outlive the parsing and the run.
void add_drawing_commands(CLI::App& app, AllOptions& options, std::function<void()>& run);

/// Commands about data: info, phantom, list, plot, warp, pick, slice, transfer, camera, export.
void add_data_commands(CLI::App& app, AllOptions& options, std::function<void()>& run);

} // namespace slicelens::cli
