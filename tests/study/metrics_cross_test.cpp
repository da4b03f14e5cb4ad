// The metrics against other people's programs, where those are installed.
#include "catch.h"
#include "image/image_io.h"
#include "metrics_images.h"
#include "study/flip.h"
#include "study/metrics.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>

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

/// Two pictures, as PNG files and as raw floats (RGBA) in a folder of their own.
struct Pair {
  fs::path folder = fs::temp_directory_path() / ("slicelens_metrics_" + std::to_string(::getpid()));
  Image a;
  Image b;
  Pair(int width, int height)
      : a(textured_image(width, height, 0, 1)), b(textured_image(width, height, 0.1, 2)) {
    fs::create_directories(folder);
    write_image(a, folder / "a.png", PixelDepth::png8);
    write_image(b, folder / "b.png", PixelDepth::png8);
    for (const auto& [image, name] : {std::pair{&a, "a.raw"}, {&b, "b.raw"}}) {
      std::ofstream out(folder / name, std::ios::binary);
      out.write(reinterpret_cast<const char*>(image->pixels.data()),
                static_cast<std::streamsize>(image->pixels.size() * sizeof(float)));
    }
  }
  ~Pair() {
    std::error_code error;
    fs::remove_all(folder, error);
  }
  Pair(const Pair&) = delete;
  Pair& operator=(const Pair&) = delete;
};

/// A Python with SciPy; empty where there is none.
std::string python_with_scipy() {
  std::string python;
  for (const std::string candidate : {"python3", "/usr/bin/python3"}) {
    if (output_of(candidate + " -c 'import scipy.ndimage; print(\"yes\")'") == "yes\n")
      python = candidate;
  }
  return python;
}

/// The numbers that a script prints which is given the pictures' raw files, width and height.
std::vector<double> numbers_of(const std::string& python, const Pair& pair, const std::string& script) {
  std::ofstream(pair.folder / "script.py") << script;
  const std::string text =
      output_of(python + " '" + (pair.folder / "script.py").string() + "' '" +
                (pair.folder / "a.raw").string() + "' '" + (pair.folder / "b.raw").string() + "' " +
                std::to_string(pair.a.width) + " " + std::to_string(pair.a.height));
  INFO(text);
  std::istringstream in(text);
  std::vector<double> numbers;
  for (double number = 0; in >> number;)
    numbers.push_back(number);
  CHECK(in.eof()); // nothing but numbers
  REQUIRE_FALSE(numbers.empty());
  return numbers;
}

} // namespace

TEST_CASE("PSNR equals FFmpeg's") {
  if (output_of("ffmpeg -version").rfind("ffmpeg version", 0) != 0)
    SLICELENS_SKIP("ffmpeg is not installed");
  const Pair pair(96, 64);
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
  const std::string python = python_with_scipy();
  if (python.empty())
    SLICELENS_SKIP("Python with SciPy is not installed");
  const Pair pair(96, 64);
  const auto numbers = numbers_of(python, pair, R"(
import sys, numpy as np
from scipy.ndimage import gaussian_filter
w, h = int(sys.argv[3]), int(sys.argv[4])
def luma(name):
    p = np.fromfile(name, np.float32).astype(float).reshape(h, w, 4)
    return p[..., :3] @ [.2126, .7152, .0722]
a, b = luma(sys.argv[1]), luma(sys.argv[2])
g = lambda x: gaussian_filter(x, 1.5, truncate=3.5)  # radius 5
ma, mb = g(a), g(b)
va, vb, ab = g(a * a) - ma * ma, g(b * b) - mb * mb, g(a * b) - ma * mb
s = (2 * ma * mb + .01**2) * (2 * ab + .03**2) / ((ma**2 + mb**2 + .01**2) * (va + vb + .03**2))
print(repr(float(s[5:-5, 5:-5].mean())))
)");
  CHECK(compare_images(pair.a, pair.b).ssim == Approx(numbers.at(0)).margin(1e-10));
}

TEST_CASE("multi-scale SSIM equals the same formula over five scales in SciPy") {
  const std::string python = python_with_scipy();
  if (python.empty())
    SLICELENS_SKIP("Python with SciPy is not installed");
  // Sides of which some halves are odd: 203, 102, 51, 26, 13.
  const Pair pair(203, 181);
  const auto numbers = numbers_of(python, pair, R"(
import sys, numpy as np
from scipy.ndimage import gaussian_filter
w, h = int(sys.argv[3]), int(sys.argv[4])
def luma(name):
    p = np.fromfile(name, np.float32).astype(float).reshape(h, w, 4)
    return p[..., :3] @ [.2126, .7152, .0722]
def half(x):  # squares of 2x2, an odd border mirrored
    x = np.pad(x, [(0, n % 2) for n in x.shape], mode='symmetric')
    return x.reshape(x.shape[0] // 2, 2, x.shape[1] // 2, 2).mean((1, 3))
g = lambda x: gaussian_filter(x, 1.5, truncate=3.5)[5:-5, 5:-5]
a, b = luma(sys.argv[1]), luma(sys.argv[2])
product = 1
for scale, beta in enumerate([.0448, .2856, .3001, .2363, .1333]):
    if scale:
        a, b = half(a), half(b)
    ma, mb = g(a), g(b)
    va, vb, ab = g(a * a) - ma * ma, g(b * b) - mb * mb, g(a * b) - ma * mb
    cs = (2 * ab + .03**2) / (va + vb + .03**2)
    if scale == 4:
        cs = cs * (2 * ma * mb + .01**2) / (ma**2 + mb**2 + .01**2)
    product *= cs.mean() ** beta
print(repr(float(product)))
)");
  const auto ms_ssim = compare_images(pair.a, pair.b).ms_ssim;
  REQUIRE(ms_ssim);
  CHECK(*ms_ssim == Approx(numbers.at(0)).margin(1e-10)); // double rounding
  CHECK(*ms_ssim < 0.99);
}

TEST_CASE("FLIP equals full two-dimensional kernels in SciPy") {
  const std::string python = python_with_scipy();
  if (python.empty())
    SLICELENS_SKIP("Python with SciPy is not installed");
  const Pair pair(72, 50);
  // The authors' program rounds white and the inverse matrix to nine digits; so does this.
  const auto numbers = numbers_of(python, pair, R"(
import sys, numpy as np
from scipy.ndimage import correlate
w, h = int(sys.argv[3]), int(sys.argv[4])
white = np.array([0.950428545, 1.0, 1.088900371])
to_xyz = np.array([[10135552 / 24577794, 8788810 / 24577794, 4435075 / 24577794],
                   [2613072 / 12288897, 8788810 / 12288897, 887015 / 12288897],
                   [1425312 / 73733382, 8788810 / 73733382, 70074185 / 73733382]])
to_rgb = np.array([[3.241003275, -1.537398934, -0.498615861],
                   [-0.969224334, 1.875930071, 0.041554224],
                   [0.055639423, -0.204011202, 1.057148933]])
def grid(radius):
    return np.meshgrid(np.arange(-radius, radius + 1), np.arange(-radius, radius + 1))
def csf(ppd, parts):
    x, y = grid(int(np.ceil(3 * np.sqrt(.04 / (2 * np.pi**2)) * ppd)))
    d2 = (x**2 + y**2) / ppd**2
    k = sum(a * np.sqrt(np.pi / b) * np.exp(-np.pi**2 * d2 / b) for a, b in parts)
    return k / k.sum()
def opponent(v):
    return np.stack([116 * v[..., 1] - 16, 500 * (v[..., 0] - v[..., 1]), 200 * (v[..., 1] - v[..., 2])], -1)
def hunt(rgb):
    t = rgb @ to_xyz.T / white
    lab = opponent(np.where(t > (6 / 29)**3, np.cbrt(t), t / (3 * (6 / 29)**2) + 4 / 29))
    lab[..., 1:] *= .01 * lab[..., :1]
    return lab
def hyab(p, q):
    return np.abs(p[..., 0] - q[..., 0]) + np.sqrt(((p[..., 1:] - q[..., 1:])**2).sum(-1))
def features(y, ppd):
    sd = .5 * .082 * ppd
    gx, gy = grid(int(np.ceil(3 * sd)))
    g = np.exp(-(gx**2 + gy**2) / (2 * sd * sd))
    out = []
    for k in (-gx * g, (gx**2 / sd**2 - 1) * g):
        k = np.where(k < 0, k / -k[k < 0].sum(), k / k[k > 0].sum())
        out.append(np.hypot(correlate(y, k, mode='nearest'), correlate(y, k.T, mode='nearest')))
    return out
def percept(name, ppd):
    v = np.clip(np.fromfile(name, np.float32).astype(float).reshape(h, w, 4)[..., :3], 0, 1)
    v = np.where(v > .04045, ((v + .055) / 1.055)**2.4, v / 12.92) @ to_xyz.T / white
    c = opponent(v)
    kernels = [[(1, .0047)], [(1, .0053)], [(34.1, .04), (13.5, .025)]]
    c = np.stack([correlate(c[..., i], csf(ppd, k), mode='nearest') for i, k in enumerate(kernels)], -1)
    y = (c[..., 0] + 16) / 116
    rgb = np.stack([y + c[..., 1] / 500, y, y - c[..., 2] / 200], -1) * white @ to_rgb.T
    return hunt(np.clip(rgb, 0, 1)), features(v[..., 1], ppd)
cmax = hyab(hunt(np.array([0., 1, 0])), hunt(np.array([0., 0, 1])))**.7
for ppd in (3840 * np.pi / 180, 25.0):
    (ca, fa), (cb, fb) = percept(sys.argv[1], ppd), percept(sys.argv[2], ppd)
    e = hyab(ca, cb)**.7
    knee = .4 * cmax
    e = np.where(e < knee, .95 / knee * e, .95 + .05 * (e - knee) / (cmax - knee))
    f = np.maximum(abs(fa[0] - fb[0]), abs(fa[1] - fb[1]))
    e = e**(1 - (f / np.sqrt(2))**.5)
    print(repr(float(e.mean())), repr(float(e[0, 0])), repr(float(e[20, 33])), repr(float(e.max())))
)");
  REQUIRE(numbers.size() == 8);
  for (const std::size_t row : {0, 1}) {
    const PixelPlane errors =
        flip_errors(pair.a, pair.b, glm::dvec3(0), glm::dvec3(0), row == 0 ? default_pixels_per_degree : 25);
    // Nine digits of white and the matrix, magnified by a* and b* (500, 200) and the exponents.
    CHECK(mean_of(errors) == Approx(numbers[4 * row]).margin(1e-7));
    CHECK(errors.at(0, 0) == Approx(numbers[4 * row + 1]).margin(1e-6));
    CHECK(errors.at(33, 20) == Approx(numbers[4 * row + 2]).margin(1e-6));
    CHECK(*std::max_element(errors.values.begin(), errors.values.end()) ==
          Approx(numbers[4 * row + 3]).margin(1e-6));
  }
}
