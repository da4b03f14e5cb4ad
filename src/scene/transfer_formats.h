// The single formats behind scene/transfer_files.h. For this folder only.
#pragma once

#include "scene/transfer_files.h"

#include <string>

namespace slicelens::transfer_formats {

TransferFile read_paraview_json(const std::filesystem::path& path, const std::string& map);
TransferFile read_paraview_xml(const std::filesystem::path& path, const std::string& map);
TransferFile read_slicer_text(const std::filesystem::path& path);
TransferFile read_slicer_json(const std::filesystem::path& path);
TransferFile read_table(const std::filesystem::path& path);

std::string paraview_json_text(const TransferToWrite& what);
std::string slicer_text(const TransferToWrite& what);
std::string slicer_json_text(const TransferToWrite& what);
/// `deviation` receives the largest difference of any channel from the function.
std::string table_text(const TransferToWrite& what, double& deviation);

/// The points with steps as two neighbouring doubles.
std::vector<TransferPoint> written_points(const TransferFunction& transfer);

/// Moves points at neighbouring doubles onto one value.
void join_steps(ColorCurve& curve);
void join_steps(OpacityCurve& curve);

/// The index of the map of this name. `names` holds those of all maps in the file.
std::size_t choose_map(const std::filesystem::path& path, const std::vector<std::string>& names,
                       const std::string& map);

/// Throws FileError for more points than a curve may have.
void check_count(const std::filesystem::path& path, const std::string& what, std::size_t count);

} // namespace slicelens::transfer_formats
