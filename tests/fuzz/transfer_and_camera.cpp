// Transfer functions and cameras of other programs. The first byte chooses the format. What is read is
// written in every format that can be written, and formats that promise it give the same function again.
#include "core/box.h"
#include "fuzz.h"
#include "scene/camera_files.h"
#include "scene/transfer_files.h"

#include <array>
#include <cmath>
#include <cstring>
#include <string>

namespace {

using namespace slicelens;

[[noreturn]] void differs(const char* what, const std::filesystem::path& path) {
  std::fprintf(stderr, "%s: %s\n", path.filename().c_str(), what);
  std::abort();
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0 || (a == 0 && b == 0); }

/// Points closer than a few doubles, but not equal, may be joined into a step on the way (join_steps).
bool keeps_its_steps(const TransferFunction& transfer) {
  for (std::size_t i = 1; i < transfer.points.size(); ++i) {
    const double low = transfer.points[i - 1].value;
    const double high = transfer.points[i].value;
    const double gap = 8 * (std::nextafter(std::abs(low), INFINITY) - std::abs(low));
    if (low != high && high - low <= gap)
      return false;
  }
  return true;
}

bool same(const TransferFunction& a, const TransferFunction& b) {
  if (a.points.size() != b.points.size())
    return false;
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    const TransferPoint& p = a.points[i];
    const TransferPoint& q = b.points[i];
    if (!same_bits(p.value, q.value) || !same_bits(p.r, q.r) || !same_bits(p.g, q.g) ||
        !same_bits(p.b, q.b) || !same_bits(p.opacity, q.opacity))
      return false;
  }
  return true;
}

void check_round_trips(const TransferFile& file, const TransferFunction& transfer) {
  TransferToWrite what;
  what.transfer = transfer;
  what.display = file.display;
  for (const char* name : {"written.json", "written.vp", "written.vp.json"}) {
    const auto path = fuzz::folder() / name;
    write_transfer_file(path, what);
    try {
      const ReadTransfer again = transfer_of(read_transfer_file(path), path);
      if (keeps_its_steps(transfer) && !same(again.transfer, transfer))
        differs("another function than was written", path);
    } catch (const Error& error) {
      differs(error.what(), path);
    }
  }
  what.rows = 16;
  what.rows_range = {transfer.points.front().value, transfer.points.back().value};
  write_transfer_file(fuzz::folder() / "written.1dt", what); // refuses an empty range
}

void read_transfer(const std::filesystem::path& path) {
  const TransferFile file = read_transfer_file(path);
  const ReadTransfer read = transfer_of(file, path);
  fuzz::one_line_or_value([&] { transfer_of(file, path, ValueRange{-100, 300}); });
  // Resampled functions can be long, and everything about them has been looked at by then.
  if (read.transfer.points.size() <= 64)
    fuzz::one_line_or_value([&] { check_round_trips(file, read.transfer); });
}

void read_camera(const std::filesystem::path& path) {
  const ReadCamera read = read_camera_file(path);
  const CameraSettings first = explicit_camera(read.camera, Box{});
  const auto written = fuzz::folder() / "written.pvcc";
  write_camera_file(written, first);
  try {
    const CameraSettings second = read_camera_file(written).camera;
    if (second.position != first.position || second.focal_point != first.focal_point ||
        second.view_up != first.view_up || second.view_angle != first.view_angle ||
        second.parallel_scale != first.parallel_scale || second.projection != first.projection)
      differs("another camera than was written", written);
  } catch (const Error& error) {
    differs(error.what(), written);
  }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0)
    return 0;
  static const std::array<const char*, 6> names = {"map.json",    "map.xml", "map.vp",
                                                   "map.vp.json", "map.1dt", "map.pvcc"};
  const char* name = names[data[0] % names.size()];
  const auto file = fuzz::write(name, fuzz::text_of(data + 1, size - 1));
  return fuzz::one_line_or_value(
      [&] { std::strstr(name, "pvcc") != nullptr ? read_camera(file) : read_transfer(file); });
}
