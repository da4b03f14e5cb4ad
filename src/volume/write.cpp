#include "volume/write.h"

#include "core/errors.h"
#include "core/files.h"
#include "core/text.h"
#include "volume/file_checks.h"
#include "volume/header_scan.h"
#include "volume/itk_reading.h"
#include "volume/nrrd_header.h"

#include <itkMetaImageIO.h>
#include <itkNrrdImageIO.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <system_error>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

itk::IOComponentEnum component_of(ScalarType type) {
  switch (type) {
  case ScalarType::u8:
    return itk::IOComponentEnum::UCHAR;
  case ScalarType::i8:
    return itk::IOComponentEnum::CHAR;
  case ScalarType::u16:
    return itk::IOComponentEnum::USHORT;
  case ScalarType::i16:
    return itk::IOComponentEnum::SHORT;
  case ScalarType::u32:
    return itk::IOComponentEnum::UINT;
  case ScalarType::i32:
    return itk::IOComponentEnum::INT;
  case ScalarType::u64:
    return itk::IOComponentEnum::ULONGLONG;
  case ScalarType::i64:
    return itk::IOComponentEnum::LONGLONG;
  case ScalarType::f32:
    return itk::IOComponentEnum::FLOAT;
  case ScalarType::f64:
    break;
  }
  return itk::IOComponentEnum::DOUBLE;
}

void describe(itk::ImageIOBase& io, const Volume& volume, bool compress) {
  io.SetNumberOfDimensions(3);
  itk::ImageIORegion region(3);
  for (unsigned axis = 0; axis < 3; ++axis) {
    const int a = static_cast<int>(axis);
    io.SetDimensions(axis, volume.dims[axis]);
    io.SetSpacing(axis, volume.spacing[a]);
    io.SetOrigin(axis, volume.origin[a]);
    const glm::dvec3 column = volume.direction[a];
    io.SetDirection(axis, std::vector<double>{column.x, column.y, column.z});
    region.SetIndex(axis, 0);
    region.SetSize(axis, volume.dims[axis]);
  }
  io.SetIORegion(region);
  io.SetComponentType(component_of(volume.type));
  io.SetNumberOfComponents(static_cast<unsigned>(volume.components));
  io.SetPixelType(volume.components == 1 ? itk::IOPixelEnum::SCALAR : itk::IOPixelEnum::VECTOR);
  io.SetUseCompression(compress);
}

[[noreturn]] void throw_unwritten(const fs::path& path, const std::string& why) {
  throw FileError(path.string(), "cannot be written in full (" + why + "); is the disk full?");
}

/// Writes into `file` through ITK and looks at what arrived: its writers do not report every full disk.
void write_with_itk(const Volume& volume, const fs::path& file, const fs::path& path, bool meta,
                    bool compress) {
  with_libraries(path, {}, [&] {
    itk::ImageIOBase::Pointer io;
    if (meta) {
      const auto meta_io = itk::MetaImageIO::New();
      meta_io->SetDoublePrecision(17);
      io = meta_io.GetPointer();
    } else {
      io = itk::NrrdImageIO::New().GetPointer();
    }
    io->SetFileName(file.string());
    describe(*io, volume, compress);
    io->WriteImageInformation();
    io->Write(volume.voxels.data());
  });
  if (meta)
    scan_meta(file);
  else
    parse_nrrd(file);
}

/// The data files that a header names: none when the voxels follow it.
std::vector<fs::path> data_files_of(const fs::path& header, bool meta) {
  return meta ? scan_meta(header).data_files : parse_nrrd(header).data_files;
}

/// A header of ITK's for one voxel, with the sizes of `volume` instead: nothing else in it depends on them.
std::string with_sizes_of(const Volume& volume, std::string header, bool meta) {
  const std::string one = "1 1 1";
  const std::size_t line = header.find(meta ? "\nDimSize = " : "\nsizes: ");
  const std::size_t end = header.find('\n', line + 1);
  header.replace(end - one.size(), one.size(),
                 std::to_string(volume.dims[0]) + " " + std::to_string(volume.dims[1]) + " " +
                     std::to_string(volume.dims[2]));
  return header;
}

/// `header` and then, into `data`, all rows. The two may be one file.
void write_header_and_rows(const Volume& volume, const RowSource& rows, const std::string& header,
                           const fs::path& file, const fs::path& data, const fs::path& path,
                           const Progress& progress) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out << header;
  if (data != file) {
    out.close();
    if (!out)
      throw_unwritten(path, std::strerror(errno));
    out.open(data, std::ios::binary | std::ios::trunc);
  }
  const std::size_t total = volume.dims[1] * volume.dims[2];
  const std::size_t row_bytes = voxel_bytes(volume) / total;
  const std::size_t chunk = std::clamp<std::size_t>((std::size_t{32} << 20) / row_bytes, 1, total);
  std::vector<std::byte> buffer(chunk * row_bytes);
  for (std::size_t row = 0; row < total && out; row += chunk) {
    report_progress(progress, "write", static_cast<double>(row) / static_cast<double>(total));
    const std::span<std::byte> part(buffer.data(), std::min(chunk, total - row) * row_bytes);
    rows(row, part);
    out.write(reinterpret_cast<const char*>(part.data()), static_cast<std::streamsize>(part.size()));
  }
  out.close();
  if (!out)
    throw_unwritten(path, std::strerror(errno));
  report_progress(progress, "write", 1);
}

void write_in_rows(const Volume& volume, const RowSource& rows, const fs::path& file, const fs::path& path,
                   bool meta, const Progress& progress) {
  Volume one = volume;
  one.dims = {1, 1, 1};
  one.voxels.assign(voxel_bytes(one), std::byte{0});
  write_with_itk(one, file, path, meta, false);
  const std::vector<fs::path> data = data_files_of(file, meta);
  std::string header = read_text(file);
  if (data.empty())
    header.resize(header.size() - one.voxels.size());
  header = with_sizes_of(volume, std::move(header), meta);
  write_header_and_rows(volume, rows, header, file, data.empty() ? file : data.front(), path, progress);
}

/// Throws FileError where the disk of `path` has no room for `volume`. Nothing where the system does not say.
void check_room(const Volume& volume, const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code error;
  const fs::space_info space = fs::space(folder, error);
  const std::size_t needed = voxel_bytes(volume);
  if (error || space.available >= needed)
    return;
  const auto gib = [](std::uintmax_t bytes) {
    return number_text(std::round(static_cast<double>(bytes) / (1 << 30) * 10) / 10) + " GiB";
  };
  throw FileError(path.string(), "needs " + gib(needed) + " and the disk has " + gib(space.available) +
                                     " left; make room or write elsewhere");
}

/// Moves `from` to `to`, or throws naming `path`.
void move_file(const fs::path& from, const fs::path& to, const fs::path& path) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error)
    throw FileError(path.string(), "cannot be put in place: " + error.message());
}

/// Writes a header, and with it the data file that it names if it names one, under the name it is given.
using Writer = std::function<void(const fs::path& header)>;

/// A header and its data file: both are made under their names in a folder of their own beside the target.
/// The voxels are moved first, the header last; when that fails the old voxels are put back.
void write_pair(const fs::path& path, bool meta, const Writer& write) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  fs::path made;
  fs::path data;
  bool has_old = false;
  std::error_code error;
  try {
    write_atomically(path, [&](const fs::path& temporary) {
      made = temporary;
      made.replace_extension(".folder");
      fs::create_directory(made, error);
      if (error)
        throw FileError(path.string(), "cannot be written: " + error.message());
      const fs::path header = made / path.filename();
      write(header);
      const auto files = data_files_of(header, meta);
      if (files.size() != 1)
        throw_unwritten(path, "no data file");
      data = files.front().filename();
      move_file(header, temporary, path);
      if (fs::exists(folder / data, error)) {
        move_file(folder / data, made / "old", path);
        has_old = true;
      }
      move_file(made / data, folder / data, path);
    });
  } catch (...) {
    if (has_old)
      fs::rename(made / "old", folder / data, error);
    if (!made.empty())
      fs::remove_all(made, error);
    throw;
  }
  fs::remove_all(made, error);
}

bool is_meta(const fs::path& path) {
  const std::string extension = lower(path.extension().string());
  const bool meta = extension == ".mha" || extension == ".mhd";
  if (!meta && extension != ".nrrd" && extension != ".nhdr")
    throw UsageError(path.string() + ": a volume is written as .nrrd, .nhdr, .mha or .mhd");
  return meta;
}

/// One file or two, which appear when they are complete.
void write_files(const fs::path& path, bool meta, const Writer& write) {
  const std::string extension = lower(path.extension().string());
  try {
    if (extension == ".mhd" || extension == ".nhdr")
      write_pair(path, meta, write);
    else
      write_atomically(path, write);
  } catch (const FileError& error) {
    // Scans of the temporary files name them; the user knows only `path`.
    const std::string text = error.what();
    if (text.rfind(path.string() + ":", 0) == 0)
      throw;
    throw_unwritten(path, one_line(text.substr(text.find(": ") + 2)));
  }
}

} // namespace

void write_volume(const Volume& volume, const fs::path& path, const WriteOptions& options) {
  const bool meta = is_meta(path);
  if (volume.voxels.size() != voxel_bytes(volume) || volume.voxels.empty())
    throw UsageError(path.string() + ": the volume has no voxels to write");
  write_files(path, meta,
              [&](const fs::path& file) { write_with_itk(volume, file, path, meta, options.compress); });
}

void write_rows(const Volume& volume, const RowSource& rows, const fs::path& path, const Progress& progress) {
  const bool meta = is_meta(path);
  if (voxel_bytes(volume) == 0)
    throw UsageError(path.string() + ": the volume has no voxels to write");
  write_files(path, meta, [&](const fs::path& file) {
    check_room(volume, path);
    write_in_rows(volume, rows, file, path, meta, progress);
  });
}

} // namespace slicelens
