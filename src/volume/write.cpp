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

[[noreturn]] void throw_unwritten(const fs::path& path, const std::string& why) {
  throw FileError(path.string(), "cannot be written in full (" + why + "); is the disk full?");
}

/// Moves `from` to `to`, or throws naming `path`.
void move_file(const fs::path& from, const fs::path& to, const fs::path& path) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error)
    throw FileError(path.string(), "cannot be put in place: " + error.message());
}

/// A header and its data file: both are made under their names in a folder of their own beside the target.
/// The voxels are moved first, the header last; when that fails the old voxels are put back.
void write_pair(const Volume& volume, const fs::path& path, bool meta, bool compress) {
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
      write_with_itk(volume, header, path, meta, compress);
      const auto files = meta ? scan_meta(header).data_files : parse_nrrd(header).data_files;
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

} // namespace

void write_volume(const Volume& volume, const fs::path& path, const WriteOptions& options) {
  const std::string extension = lower(path.extension().string());
  const bool meta = extension == ".mha" || extension == ".mhd";
  if (!meta && extension != ".nrrd" && extension != ".nhdr")
    throw UsageError(path.string() + ": a volume is written as .nrrd, .nhdr, .mha or .mhd");
  if (volume.voxels.size() != voxel_bytes(volume) || volume.voxels.empty())
    throw UsageError(path.string() + ": the volume has no voxels to write");
  const auto checked = [&](const auto& write) {
    try {
      write();
    } catch (const FileError& error) {
      // Scans of the temporary files name them; the user knows only `path`.
      const std::string text = error.what();
      if (text.rfind(path.string() + ":", 0) == 0)
        throw;
      throw_unwritten(path, one_line(text.substr(text.find(": ") + 2)));
    }
  };
  if (extension == ".mhd" || extension == ".nhdr") {
    checked([&] { write_pair(volume, path, meta, options.compress); });
    return;
  }
  checked([&] {
    write_atomically(path, [&](const fs::path& temporary) {
      write_with_itk(volume, temporary, path, meta, options.compress);
    });
  });
}

} // namespace slicelens
