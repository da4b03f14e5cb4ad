// Reading landmarks: pairs and lists of points.
#pragma once

#include "warp/landmarks.h"

#include <filesystem>
#include <vector>

namespace slicelens {

/// Pairs as the file gives them: .json [[[sx,sy,sz],[tx,ty,tz]], …]; .csv or .txt with lines
/// sx,sy,sz,tx,ty,tz. In CSV a first line of words is a heading, and lines that begin with # are left out.
/// Throws FileError naming the line or entry at fault; for 3D Slicer's lists, which hold single points, it
/// says what to do.
std::vector<LandmarkPair> read_landmark_pairs(const std::filesystem::path& path);

/// Points: .json [[x,y,z], …]; .csv or .txt with lines x,y,z; 3D Slicer's .fcsv and .mrk.json, which are
/// turned to LPS as their CoordinateSystem says. With `texture` those two are refused: they are in world
/// space.
std::vector<glm::dvec3> read_points(const std::filesystem::path& path, bool texture);

} // namespace slicelens
