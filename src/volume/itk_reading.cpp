#include "volume/itk_reading.h"

#include "core/errors.h"
#include "core/text.h"
#include "volume/file_checks.h"

#include <fcntl.h>
#include <gdcmTrace.h>
#include <itkOutputWindow.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <mutex>
#include <regex>
#include <sstream>

// Sanitizers report to stderr too (GCC's macro and clang's way of asking).
#if defined(__has_feature)
#if !__has_feature(address_sanitizer)
#define SLICELENS_CAPTURE_STDERR
#endif
#elif !defined(__SANITIZE_ADDRESS__)
#define SLICELENS_CAPTURE_STDERR
#endif

namespace slicelens {

namespace fs = std::filesystem;

namespace {

/// Collects ITK's messages; its threads may call at the same time.
class CollectingWindow : public itk::OutputWindow {
public:
  using Self = CollectingWindow;
  using Superclass = itk::OutputWindow;
  using Pointer = itk::SmartPointer<Self>;
  itkFactorylessNewMacro(Self);
  itkTypeMacro(CollectingWindow, OutputWindow);

  void DisplayText(const char* text) override {
    const std::lock_guard lock(mutex_);
    text_ += text;
    text_ += '\n';
  }
  std::string take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(text_, {});
  }

private:
  std::mutex mutex_;
  std::string text_;
};

ScalarType scalar_type_of(const fs::path& path, itk::IOComponentEnum type) {
  switch (type) {
  case itk::IOComponentEnum::UCHAR:
    return ScalarType::u8;
  case itk::IOComponentEnum::CHAR:
    return ScalarType::i8;
  case itk::IOComponentEnum::USHORT:
    return ScalarType::u16;
  case itk::IOComponentEnum::SHORT:
    return ScalarType::i16;
  case itk::IOComponentEnum::UINT:
    return ScalarType::u32;
  case itk::IOComponentEnum::INT:
    return ScalarType::i32;
  case itk::IOComponentEnum::ULONG:
    return sizeof(long) == 8 ? ScalarType::u64 : ScalarType::u32;
  case itk::IOComponentEnum::LONG:
    return sizeof(long) == 8 ? ScalarType::i64 : ScalarType::i32;
  case itk::IOComponentEnum::ULONGLONG:
    return ScalarType::u64;
  case itk::IOComponentEnum::LONGLONG:
    return ScalarType::i64;
  case itk::IOComponentEnum::FLOAT:
    return ScalarType::f32;
  case itk::IOComponentEnum::DOUBLE:
    return ScalarType::f64;
  default:
    break;
  }
  throw FileError(path.string(), "its scalar type '" + itk::ImageIOBase::GetComponentTypeAsString(type) +
                                     "' is not supported; integers of 8 to 64 bits, float and double are");
}

void read_geometry(itk::ImageIOBase& io, const fs::path& path, Volume& volume) {
  const unsigned dimensions = io.GetNumberOfDimensions();
  for (unsigned axis = 0; axis < 3 && axis < dimensions; ++axis) {
    const int a = static_cast<int>(axis);
    double spacing = io.GetSpacing(axis);
    const std::vector<double> direction = io.GetDirection(axis);
    glm::dvec3 column(0);
    for (unsigned row = 0; row < 3 && row < dimensions; ++row)
      column[static_cast<int>(row)] = direction[row];
    if (!std::isfinite(spacing) || spacing == 0)
      throw FileError(path.string(), "the spacing of axis " + std::to_string(axis) + " is " +
                                         number_text(spacing) + "; a finite number above 0 is needed");
    if (spacing < 0) { // the axis runs the other way
      spacing = -spacing;
      column = -column;
    }
    const double length = glm::length(column);
    if (!std::isfinite(length) || length < 1e-9)
      throw FileError(path.string(), "the direction of axis " + std::to_string(axis) + " has no length");
    volume.spacing[a] = spacing;
    volume.direction[a] = column / length;
    volume.origin[a] = io.GetOrigin(axis);
    if (!std::isfinite(volume.origin[a]))
      throw FileError(path.string(), "the origin is " + number_text(volume.origin[a]) + " on axis " +
                                         std::to_string(axis) + "; finite numbers are needed");
  }
  if (dimensions == 2)
    volume.direction[2] = glm::cross(volume.direction[0], volume.direction[1]);
  if (std::abs(glm::determinant(volume.direction)) < 1e-6)
    throw FileError(path.string(), "its axes lie in one plane; the direction is damaged");
}

/// What is written to file descriptor 2 while one lives. libjpeg inside GDCM and niftilib print there with C
/// stdio and cannot be told otherwise. Sanitizers report there too, so their builds leave it alone.
class CapturedStderr {
public:
  CapturedStderr() {
#ifdef SLICELENS_CAPTURE_STDERR
    std::fflush(stderr);
    file_ = ::memfd_create("slicelens messages", MFD_CLOEXEC);
    saved_ = file_ < 0 ? -1 : ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
    if (saved_ >= 0)
      ::dup2(file_, STDERR_FILENO);
#endif
  }
  ~CapturedStderr() { release(); }
  CapturedStderr(const CapturedStderr&) = delete;
  CapturedStderr& operator=(const CapturedStderr&) = delete;

  /// Gives stderr back and returns what was written.
  std::string release() {
    std::string text;
    if (saved_ >= 0) {
      std::fflush(stderr);
      ::dup2(saved_, STDERR_FILENO);
      ::close(saved_);
      text.resize(1 << 16);
      const ssize_t count = ::pread(file_, text.data(), text.size(), 0);
      text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    }
    if (file_ >= 0)
      ::close(file_);
    saved_ = file_ = -1;
    return text;
  }

private:
  int file_ = -1;
  int saved_ = -1;
};

} // namespace

struct LibraryMessages::State {
  /// What is redirected is the process's own, so threads that read slices of volumes on disk take turns.
  static std::mutex& turn() {
    static std::mutex mutex;
    return mutex;
  }

  std::unique_lock<std::mutex> lock;
  const Progress& progress;
  std::string label;
  itk::OutputWindow::Pointer old_window;
  CollectingWindow::Pointer window;
  std::ostringstream stream;
  std::streambuf* old_cerr = nullptr;
  bool discarded = false;
  CapturedStderr captured;
};

LibraryMessages::LibraryMessages(const std::string& label, const Progress& progress)
    : state_(new State{std::unique_lock(State::turn()),
                       progress,
                       label,
                       itk::OutputWindow::GetInstance(),
                       CollectingWindow::New(),
                       {},
                       nullptr,
                       false,
                       {}}) {
  itk::OutputWindow::SetInstance(state_->window);
  gdcm::Trace::SetStream(state_->stream);
  // MetaIO and parts of ITK print their errors to std::cerr and return a status; the status becomes our
  // error.
  state_->old_cerr = std::cerr.rdbuf(state_->stream.rdbuf());
}

LibraryMessages::~LibraryMessages() {
  std::cerr.rdbuf(state_->old_cerr);
  gdcm::Trace::SetStream(std::cerr);
  itk::OutputWindow::SetInstance(state_->old_window);
  std::istringstream lines(state_->window->take() + state_->stream.str() + "\n" + state_->captured.release());
  if (state_->discarded)
    return;
  std::vector<std::string> said;
  for (std::string line; std::getline(lines, line);) {
    line = one_line(line);
    // Every warning comes with a line that names a source file of the library, which says nothing to a user.
    const std::string start = lower(line.substr(0, 11));
    const bool place = start == "warning: in" || start.rfind("error: in", 0) == 0 || start == "debug: in /";
    if (line.empty() || place || std::find(said.begin(), said.end(), line) != said.end() || said.size() >= 20)
      continue;
    said.push_back(line);
    report_warning(state_->progress, state_->label + ": " + line);
  }
}

void LibraryMessages::discard() { state_->discarded = true; }

void with_libraries(const fs::path& path, const Progress& progress, const std::function<void()>& work) {
  LibraryMessages messages(path.string(), progress);
  try {
    work();
  } catch (const Error&) {
    messages.discard();
    throw;
  } catch (const itk::ExceptionObject& error) {
    messages.discard();
    std::string text = error.GetDescription();
    if (text.rfind("ITK ERROR: ", 0) == 0)
      text = text.substr(11);
    // "NrrdImageIO(0x55d0c81e3da0): …": the object's address says nothing to a user.
    text = std::regex_replace(text, std::regex("[A-Za-z0-9_]+\\(0x[0-9a-fA-F]+\\): "), "");
    std::string line = one_line(text);
    // NRRD's errors come as a stack of lines with the cause at its end.
    text = trimmed(text);
    const std::size_t last = text.find_last_of('\n');
    if (!line.empty() && line.back() == ':' && last != std::string::npos)
      line += " " + one_line(text.substr(last + 1));
    throw FileError(path.string(), "cannot be read: " + line);
  } catch (const std::bad_alloc&) {
    messages.discard();
    throw LimitError(path.string() + ": reading it needs more memory than there is");
  } catch (const std::exception& error) {
    messages.discard();
    throw FileError(path.string(), "cannot be read: " + one_line(error.what()));
  }
}

Volume header_of(itk::ImageIOBase& io, const fs::path& path, bool components_are_frames) {
  Volume volume;
  const unsigned dimensions = io.GetNumberOfDimensions();
  std::uintmax_t beyond = 1;
  for (unsigned axis = 0; axis < dimensions; ++axis) {
    const std::size_t size = io.GetDimensions(axis);
    if (size == 0)
      throw FileError(path.string(), "axis " + std::to_string(axis) + " has no voxels");
    if (axis < 3)
      volume.dims[axis] = size;
    else if (axis == 3)
      volume.frames = size;
    else
      beyond = std::max<std::uintmax_t>(beyond, size);
  }
  if (beyond > 1)
    throw FileError(path.string(), "has " + std::to_string(dimensions) +
                                       " dimensions; three, or four with one of frames, are supported");
  const itk::IOPixelEnum pixel = io.GetPixelType();
  if (pixel == itk::IOPixelEnum::COMPLEX)
    throw FileError(path.string(), "holds complex numbers; write magnitude or one part as scalars");
  const unsigned components = io.GetNumberOfComponents();
  if (components_are_frames)
    volume.frames = components;
  else if (components < 1 || components > 4)
    throw FileError(path.string(), "has " + std::to_string(components) + " components ('" +
                                       itk::ImageIOBase::GetPixelTypeAsString(pixel) +
                                       "'); 1 to 4 are supported");
  volume.components = components_are_frames ? 1 : static_cast<int>(components);
  volume.type = scalar_type_of(path, io.GetComponentType());
  read_geometry(io, path, volume);
  return volume;
}

void read_frame(itk::ImageIOBase& io, const fs::path& path, std::size_t frame, Volume& volume,
                bool components_are_frames) {
  if (frame >= volume.frames)
    throw UsageError("volume.frame is " + std::to_string(frame) + " but " + path.string() + " has " +
                     std::to_string(volume.frames) + " frame(s), counted from 0");
  const unsigned dimensions = io.GetNumberOfDimensions();
  itk::ImageIORegion region(dimensions);
  for (unsigned axis = 0; axis < dimensions; ++axis) {
    region.SetIndex(axis, 0);
    region.SetSize(axis, io.GetDimensions(axis));
  }
  const std::size_t bytes = voxel_bytes(volume);
  const bool in_parts = volume.frames > 1 && !components_are_frames && io.CanStreamRead();
  if (in_parts) {
    region.SetIndex(3, static_cast<itk::ImageIORegion::IndexValueType>(frame));
    region.SetSize(3, 1);
    io.SetUseStreamedReading(true);
  }
  io.SetIORegion(region);
  const bool whole = volume.frames > 1 && !in_parts;
  const std::size_t read_bytes = whole ? checked_product(bytes, volume.frames, path.string()) : bytes;
  check_memory(path, read_bytes);
  volume.voxels.resize(read_bytes);
  io.Read(volume.voxels.data());
  if (whole && components_are_frames) {
    // Frame f of voxel i is scalar i·frames + f: gather it to the front.
    const std::size_t scalar = size_of(volume.type);
    for (std::size_t i = 0; i < bytes / scalar; ++i)
      std::memmove(volume.voxels.data() + i * scalar,
                   volume.voxels.data() + (i * volume.frames + frame) * scalar, scalar);
  } else if (whole) {
    std::memmove(volume.voxels.data(), volume.voxels.data() + frame * bytes, bytes);
  }
  if (whole) {
    volume.voxels.resize(bytes);
    volume.voxels.shrink_to_fit();
  }
}

} // namespace slicelens
