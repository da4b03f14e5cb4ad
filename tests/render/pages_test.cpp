// Volumes larger than render.memory: which pages there are, which a picture needs, and when they are loaded.
#include "catch.h"
#include "render/pages.h"
#include "render_fixture.h"
#include "volume_fixture.h"

#include <algorithm>
#include <random>
#include <set>

using namespace slicelens;

namespace {

/// 2-byte texels, more than 1 MiB of them: paged with render.memory 1.
PreparedScene paged_scene(const std::string& render, const std::function<double(int, int, int)>& value,
                          TransferFunction transfer = grey(0.1)) {
  return prepare(
      scene_from_json(R"({"render":{"memory":1,"brick":16,"size":[64,64])" + render + "}}", "test"),
      volume_of(ScalarType::u16, {100, 96, 64}, value), std::move(transfer));
}

double ramp(int i, int j, int k) { return i + 2 * j + 3 * k; }

std::size_t page_number(const PageGrid& grid, std::size_t level, std::array<std::size_t, 3> at) {
  const PageLevel& l = grid.levels[level];
  return l.first + (at[2] * l.pages[1] + at[1]) * l.pages[0] + at[0];
}

} // namespace

TEST_CASE("a volume is paged as soon as its texture is larger than render.memory") {
  const auto paged = [](const std::string& keys, std::array<std::size_t, 3> dims, ScalarType type) {
    return is_paged(prepare(scene_from_json(R"({"render":{"size":[8,8])" + keys + "}}", "test"),
                            volume_of(type, dims, [](int i, int, int) { return i % 50; }), grey(0.1)));
  };
  // 128·64·64 texels of 2 bytes are 1 MiB to the byte.
  CHECK_FALSE(paged(R"(,"memory":1)", {128, 64, 64}, ScalarType::u16));
  CHECK(paged(R"(,"memory":1)", {129, 64, 64}, ScalarType::u16));
  CHECK(paged(R"(,"memory":1)", {128, 64, 64}, ScalarType::f32)); // texels of 4 bytes
  CHECK_FALSE(paged(R"(,"memory":1,"volume_texture":"r8")", {129, 64, 64}, ScalarType::u16));
  CHECK_FALSE(paged("", {129, 64, 64}, ScalarType::u16));
  CHECK_FALSE(paged("", {2048, 3, 2}, ScalarType::u8));
  CHECK(paged("", {2049, 3, 2}, ScalarType::u8)); // no texture of that edge is tried
  CHECK_FALSE(paged(R"(,"memory":1,"pipeline":"reference")", {129, 64, 64}, ScalarType::u16));
}

TEST_CASE("pages cover every level, the last ones less, with the overlap that filter and gradient need") {
  const PageGrid plain = page_grid(paged_scene("", ramp));
  REQUIRE(plain.levels.size() == 1);
  CHECK(plain.levels[0].pages == std::array<std::size_t, 3>{7, 6, 4}); // ⌈100/16⌉, 96/16, 64/16
  CHECK(plain.count == 7 * 6 * 4);
  CHECK(plain.overlap == 1);
  CHECK(brick_edge(plain) == 18);
  CHECK(page_grid(paged_scene(R"(,"filter":"cubic")", ramp)).overlap == 2);
  CHECK(page_grid(paged_scene(R"(,"shading":"diffuse")", ramp)).overlap == 2);
  CHECK(page_grid(paged_scene(R"(,"shading":"diffuse","filter":"cubic")", ramp)).overlap == 3);
  const PreparedScene lens = prepare(
      scene_from_json(R"({"render":{"memory":1,"brick":16,"levels":3,"shading":"diffuse","size":[64,64]},
                          "warp":{"kind":"lamar"}})",
                      "test"),
      volume_of(ScalarType::u16, {100, 96, 64}, ramp), grey(0.1));
  const PageGrid levels = page_grid(lens);
  REQUIRE(levels.levels.size() == 3);
  CHECK(levels.overlap == 3); // gradients step by voxels of the coarser of two levels
  CHECK(levels.levels[1].voxels == std::array<std::size_t, 3>{50, 48, 32});
  CHECK(levels.levels[1].pages == std::array<std::size_t, 3>{4, 3, 2});
  CHECK(levels.levels[2].pages == std::array<std::size_t, 3>{2, 2, 1}); // of 25 × 24 × 16
  CHECK(levels.levels[1].first == 168);
  CHECK(levels.levels[2].first == 168 + 24);
  CHECK(levels.levels[2].layer == 4 + 2);
  for (std::size_t page = 0; page < levels.count; ++page) {
    const PageAddress address = address_of(levels, page);
    CHECK(page_number(levels, address.level, address.at) == page);
  }
}

TEST_CASE("pages are needed where their voxels, and those that the filter adds, can matter") {
  // One voxel of 9 in zeros, the first of page (2, 1, 3): in reach of the page before on x, y and z as well.
  const auto one = [](int i, int j, int k) { return i == 32 && j == 16 && k == 48 ? 9.0 : 0.0; };
  const TransferFunction shows = {{{1, 1, 1, 1, 0}, {9, 1, 1, 1, 0.5}}, std::nullopt, "above 1"};
  const auto needed = [&](const std::string& keys, const TransferFunction& transfer) {
    const PreparedScene prepared = paged_scene(keys, one, transfer);
    const PageGrid grid = page_grid(prepared);
    const std::vector<PageContent> contents = page_contents(prepared, grid);
    std::set<std::size_t> pages;
    for (std::size_t i = 0; i < contents.size(); ++i) {
      if (contents[i].needed)
        pages.insert(i);
      CHECK(contents[i].value == 0); // the smallest value stands for what is not loaded
    }
    return pages;
  };
  const PageGrid grid = page_grid(paged_scene("", one));
  std::set<std::size_t> around; // the eight pages that meet at the voxel's corner
  for (std::size_t k = 2; k <= 3; ++k) {
    for (std::size_t j = 0; j <= 1; ++j) {
      for (std::size_t i = 1; i <= 2; ++i)
        around.insert(page_number(grid, 0, {i, j, k}));
    }
  }
  CHECK(needed("", shows) == around);
  CHECK(needed(R"(,"mode":"iso","isovalue":4)", shows) == around);
  CHECK(needed(R"(,"mode":"iso","isovalue":20)", shows).empty());
  // Pages of one value are never loaded, whatever shows.
  CHECK(needed("", grey(0.1)) == around);
  CHECK(needed(R"(,"mode":"average")", grey(0.1)) == around);
  CHECK(needed("", TransferFunction{{{20, 1, 1, 1, 0}, {30, 1, 1, 1, 1}}, std::nullopt, "above 20"}).empty());
  // Ends of segments and means look at values that show nothing.
  const auto steps = [](int i, int, int) { return i % 2; };
  const PreparedScene mean = paged_scene(R"(,"mode":"average")", steps, shows);
  for (const PageContent& page : page_contents(mean, grid))
    CHECK(page.needed);
  for (const PageContent& page : page_contents(paged_scene("", steps, shows), grid))
    CHECK_FALSE(page.needed);
}

TEST_CASE("a picture needs the pages in its view, at their depths") {
  const PreparedScene prepared = paged_scene("", ramp);
  const PageGrid grid = page_grid(prepared);
  const std::vector<PageContent> contents = page_contents(prepared, grid);
  const std::vector<PageNeed> needs = page_needs(prepared, grid, contents);
  REQUIRE(needs.size() == grid.count);
  // From the front along +y: pages of one y lie at the same depth, 16 slices each about the middle, 48.
  for (const PageNeed& need : needs) {
    const auto y = static_cast<double>(address_of(grid, need.page).at[1]);
    CHECK(static_cast<double>(need.near) == Approx(16 * y - 48).margin(0.01));
    CHECK(static_cast<double>(need.far) == Approx(16 * (y + 1) - 48).margin(0.01));
  }
  // Zoomed in on the middle, 6 voxels across: pages 2 to 4 and 3 … of x and z are in the picture.
  const PreparedScene close = changed(prepared, {"camera.parallel_scale=3"});
  for (const PageNeed& need : page_needs(close, grid, contents)) {
    const PageAddress page = address_of(grid, need.page);
    CHECK((page.at[0] == 2 || page.at[0] == 3)); // x 44 to 56: pages of 32 … 47 and 48 … 63
    CHECK((page.at[2] == 1 || page.at[2] == 2)); // z 26 to 38
  }
  CHECK(page_needs(close, grid, contents).size() == 2 * 6 * 2);
  // What clipping planes cut away is not needed.
  const PreparedScene clipped = changed(prepared, {R"(clip=[{"point":[0.5,0.5,0.5],"normal":[1,0,0]}])"});
  CHECK(page_needs(clipped, grid, contents).size() == 4 * 6 * 4); // x from 50 on: pages 3 to 6
}

TEST_CASE("parts hold all pages that their slices need, no more than the pool, in order") {
  std::mt19937 random(5);
  const auto number = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int round = 0; round < 40; ++round) {
    const bool ascending = round % 2 == 0;
    const std::int64_t width = 1 + round % 5; // numbers an entry covers
    std::vector<SliceNumbers> entries;
    for (std::int64_t k = -60; k < 60; k += width)
      entries.push_back({k, k + width - 1});
    if (!ascending)
      std::reverse(entries.begin(), entries.end());
    std::vector<std::vector<PageNeed>> needs(2);
    for (auto& volume : needs) {
      for (std::uint32_t page = 0; page < 300; ++page) {
        const double near = number(-70, 60);
        const double bottom = number(-5, 60);
        volume.push_back({page, static_cast<float>(bottom), static_cast<float>(bottom + number(1, 20)),
                          static_cast<float>(near), static_cast<float>(near + number(0.1, 12))});
      }
    }
    const std::vector<PagedVolume> volumes = {{needs[0], 60}, {needs[1], 90}};
    const std::vector<PagedBand> bands = paged_bands(volumes, entries, 64);
    int row = 0;
    for (const PagedBand& band : bands) {
      CHECK(band.bottom == row);
      row = band.top;
      std::size_t next = 0;
      for (const PagedPart& part : band.parts) {
        CHECK(part.begin == next);
        next = part.end;
        for (std::size_t v = 0; v < 2; ++v) {
          CHECK(part.pages[v].size() <= volumes[v].capacity);
          CHECK(std::is_sorted(part.pages[v].begin(), part.pages[v].end()));
          const std::set<std::uint32_t> loaded(part.pages[v].begin(), part.pages[v].end());
          CHECK(loaded.size() == part.pages[v].size());
          for (const PageNeed& need : needs[v]) {
            if (need.top < static_cast<float>(band.bottom) || need.bottom > static_cast<float>(band.top))
              continue;
            for (std::size_t e = part.begin; e < part.end; ++e) {
              const bool meets = static_cast<float>(entries[e].last) + 0.5F >= need.near &&
                                 static_cast<float>(entries[e].first) + 0.5F <= need.far;
              if (meets && loaded.count(need.page) == 0)
                FAIL("entry " << e << " lacks page " << need.page);
            }
          }
        }
      }
      CHECK(next == entries.size());
    }
    CHECK(row == 64);
    // Some rounds need several parts, or the test says nothing.
    CHECK(bands.front().parts.size() > 1);
  }
  // 200 pages everywhere at once do not fit 60 bricks, nor do they in 8 rows.
  std::vector<PageNeed> everywhere;
  for (std::uint32_t page = 0; page < 200; ++page)
    everywhere.push_back({page, 0, 64, -100, 100});
  const std::vector<PagedVolume> small = {{everywhere, 60}};
  const std::vector<SliceNumbers> one = {{0, 0}};
  CHECK_THROWS_WITH(paged_bands(small, one, 64),
                    Catch::Contains("needs 200 bricks") && Catch::Contains("holds 60"));
}

TEST_CASE("what needs the volume in one texture is refused where it is paged") {
  const auto refusal = [](const std::string& keys) {
    try {
      (void)paged_scene(keys, ramp);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK_THAT(refusal(R"(,"pipeline":"fixed-function","target":"rgba8","filter":"linear")"),
             Catch::Contains("fixed-function") || Catch::Contains("classification"));
  CHECK_THAT(refusal(R"(,"tiles":[2,1,1])"), Catch::Contains("render.tiles"));
  CHECK_THAT(refusal(R"(,"shading":"diffuse","gradient":"precomputed")"), Catch::Contains("precomputed"));
  CHECK_THAT(refusal(R"(,"shading":"diffuse","gradient":"prefiltered")"), Catch::Contains("render.memory"));
  CHECK_THAT(refusal(R"(,"brick":20)"), Catch::Contains("render.brick"));
  CHECK(refusal("") == "accepted");
}
