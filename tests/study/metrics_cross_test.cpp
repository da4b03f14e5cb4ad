// The metrics against other people's programs, where those are installed.
#include "catch.h"
#include "image/image_io.h"
#include "metrics_images.h"
#include "study/metrics.h"

#include <unistd.h>

#include <cstdio>
#include <fstream>

using namespace slicelens;
namespace fs = std::filesystem;

namespace {

/// What `command` prints.
std::string output_of(const std::string& command) {
  std::string text;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  char buffer[4096];
  while (pipe != nullptr && std::fgets(buffer, sizeof buffer, pipe) != nullptr)
    text += buffer;
  if (pipe != nullptr)
    ::pclose(pipe);
  return text;
}

struct Pair {
  fs::path folder = fs::temp_directory_path() / ("slicelens_metrics_" + std::to_string(::getpid()));
  Image a = textured_image(96, 64, 0, 1);
  Image b = textured_image(96, 64, 0.1, 2);
  Pair() {
    fs::create_directories(folder);
    write_image(a, folder / "a.png", PixelDepth::png8);
    write_image(b, folder / "b.png", PixelDepth::png8);
  }
  ~Pair() {
    std::error_code error;
    fs::remove_all(folder, error);
  }
  Pair(const Pair&) = delete;
  Pair& operator=(const Pair&) = delete;
};

} // namespace

TEST_CASE("PSNR equals FFmpeg's") {
  if (output_of("ffmpeg -version").rfind("ffmpeg version", 0) != 0)
    SLICELENS_SKIP("ffmpeg is not installed");
  const Pair pair;
  const std::string text = output_of("ffmpeg -nostdin -i '" + (pair.folder / "a.png").string() + "' -i '" +
                                     (pair.folder / "b.png").string() +
                                     "' -lavfi '[0]format=gbrp[a];[1]format=gbrp[b];[a][b]psnr' -f null -");
  const std::size_t at = text.rfind("average:");
  INFO(text);
  REQUIRE(at != std::string::npos);
  const double expected = std::stod(text.substr(at + 8));
  const Metrics m = compare_images(read_image(pair.folder / "a.png"), read_image(pair.folder / "b.png"));
  CHECK(*m.psnr == Approx(expected).margin(1e-5)); // FFmpeg prints six decimals
}

TEST_CASE("SSIM equals SciPy's Gaussian filter put into the formula") {
  std::string python;
  for (const std::string candidate : {"python3", "/usr/bin/python3"}) {
    if (output_of(candidate + " -c 'import scipy.ndimage; print(\"yes\")'") == "yes\n")
      python = candidate;
  }
  if (python.empty())
    SLICELENS_SKIP("Python with SciPy is not installed");
  const Pair pair;
  for (const auto& [image, name] : {std::pair{&pair.a, "a.raw"}, {&pair.b, "b.raw"}}) {
    std::ofstream out(pair.folder / name, std::ios::binary);
    out.write(reinterpret_cast<const char*>(image->pixels.data()),
              static_cast<std::streamsize>(image->pixels.size() * sizeof(float)));
  }
  std::ofstream(pair.folder / "ssim.py") << R"(
import sys, numpy as np
from scipy.ndimage import gaussian_filter
def luma(name):
    p = np.fromfile(name, np.float32).astype(float).reshape(64, 96, 4)
    return p[..., :3] @ [.2126, .7152, .0722]
a, b = luma(sys.argv[1]), luma(sys.argv[2])
g = lambda x: gaussian_filter(x, 1.5, truncate=3.5)  # radius 5
ma, mb = g(a), g(b)
va, vb, ab = g(a * a) - ma * ma, g(b * b) - mb * mb, g(a * b) - ma * mb
s = (2 * ma * mb + .01**2) * (2 * ab + .03**2) / ((ma**2 + mb**2 + .01**2) * (va + vb + .03**2))
print(repr(float(s[5:-5, 5:-5].mean())))
)";
  const std::string text =
      output_of(python + " '" + (pair.folder / "ssim.py").string() + "' '" +
                (pair.folder / "a.raw").string() + "' '" + (pair.folder / "b.raw").string() + "'");
  INFO(text);
  CHECK(compare_images(pair.a, pair.b).ssim == Approx(std::stod(text)).margin(1e-10));
}
