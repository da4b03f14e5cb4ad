// Which pages are in the pool together while a picture is drawn (pages.h).
#include "core/errors.h"
#include "render/pages.h"

#include <algorithm>

namespace slicelens {

namespace {

/// The entries that need a page, first to last; empty where first > last.
struct EntryRange {
  std::size_t first = 1;
  std::size_t last = 0;
};

bool touches(const PageNeed& need, const SliceNumbers& entry) {
  return static_cast<float>(entry.last) + 0.5F >= need.near &&
         static_cast<float>(entry.first) + 0.5F <= need.far;
}

EntryRange entries_of(const PageNeed& need, std::span<const SliceNumbers> entries) {
  const bool ascending = entries.front().first <= entries.back().first;
  // Entries before the first are nearer than the page where numbers ascend, else farther.
  const auto before = [&](const SliceNumbers& entry) {
    return ascending ? static_cast<float>(entry.last) + 0.5F < need.near
                     : static_cast<float>(entry.first) + 0.5F > need.far;
  };
  const auto first = std::partition_point(entries.begin(), entries.end(), before);
  const auto end =
      std::partition_point(first, entries.end(), [&](const SliceNumbers& e) { return touches(need, e); });
  if (first == end)
    return {};
  return {static_cast<std::size_t>(first - entries.begin()),
          static_cast<std::size_t>(end - entries.begin()) - 1};
}

/// A page of one of the volumes.
struct Wanted {
  EntryRange entries;
  std::size_t volume = 0;
  std::uint32_t page = 0;
};

std::vector<Wanted> wanted_in(std::span<const PagedVolume> volumes, std::span<const SliceNumbers> entries,
                              int bottom, int top) {
  std::vector<Wanted> wanted;
  for (std::size_t v = 0; v < volumes.size(); ++v) {
    for (const PageNeed& need : volumes[v].needs) {
      if (need.top < static_cast<float>(bottom) || need.bottom > static_cast<float>(top))
        continue;
      const EntryRange range = entries_of(need, entries);
      if (range.first <= range.last)
        wanted.push_back({range, v, need.page});
    }
  }
  std::stable_sort(wanted.begin(), wanted.end(),
                   [](const Wanted& a, const Wanted& b) { return a.entries.first < b.entries.first; });
  return wanted;
}

/// The parts of a band; none where the pages of one entry, `needed`, are more than a pool holds.
struct Parts {
  std::vector<PagedPart> parts;
  std::size_t needed = 0;
  std::size_t capacity = 0;
};

/// The pages of a part that is being gathered.
class Gathering {
public:
  explicit Gathering(std::span<const PagedVolume> volumes) : volumes_(volumes), counts_(volumes.size(), 0) {}

  /// Whether there was room for all of `more`; else nothing is taken.
  bool take(std::span<const Wanted> more) {
    std::vector<std::size_t> counts = counts_;
    for (const Wanted& page : more) {
      if (++counts[page.volume] > volumes_[page.volume].capacity)
        return false;
    }
    counts_ = std::move(counts);
    pages_.insert(pages_.end(), more.begin(), more.end());
    return true;
  }
  /// What take() refused: of the volume that needs most beyond its pool.
  Parts too_many(std::span<const Wanted> more) const {
    std::vector<std::size_t> counts = counts_;
    for (const Wanted& page : more)
      ++counts[page.volume];
    Parts result;
    for (std::size_t v = 0; v < counts.size(); ++v) {
      if (counts[v] > volumes_[v].capacity && counts[v] > result.needed)
        result = {{}, counts[v], volumes_[v].capacity};
    }
    return result;
  }
  /// Drops what ended before an entry.
  void drop_before(std::size_t entry) {
    std::erase_if(pages_, [&](const Wanted& page) { return page.entries.last < entry; });
    std::fill(counts_.begin(), counts_.end(), 0);
    for (const Wanted& page : pages_)
      ++counts_[page.volume];
  }
  PagedPart part(std::size_t begin, std::size_t end) const {
    PagedPart part{begin, end, std::vector<std::vector<std::uint32_t>>(volumes_.size())};
    for (const Wanted& page : pages_)
      part.pages[page.volume].push_back(page.page);
    for (std::vector<std::uint32_t>& pages : part.pages)
      std::sort(pages.begin(), pages.end());
    return part;
  }

private:
  std::span<const PagedVolume> volumes_;
  std::vector<std::size_t> counts_;
  std::vector<Wanted> pages_;
};

Parts parts_of(std::span<const PagedVolume> volumes, std::span<const Wanted> wanted, std::size_t entries) {
  Parts result;
  std::vector<PagedPart>& parts = result.parts;
  Gathering gathering(volumes);
  std::size_t begin = 0;
  std::size_t next = 0;
  for (std::size_t entry = 0; entry < entries; ++entry) {
    std::size_t end = next;
    while (end < wanted.size() && wanted[end].entries.first <= entry)
      ++end;
    const std::span<const Wanted> more = wanted.subspan(next, end - next);
    if (!gathering.take(more)) {
      if (entry > begin)
        parts.push_back(gathering.part(begin, entry));
      begin = entry;
      gathering.drop_before(entry);
      if (!gathering.take(more))
        return gathering.too_many(more);
    }
    next = end;
  }
  parts.push_back(gathering.part(begin, entries));
  return result;
}

constexpr int fewest_rows = 8;

} // namespace

std::vector<PagedBand> paged_bands(std::span<const PagedVolume> volumes,
                                   std::span<const SliceNumbers> entries, int height) {
  if (entries.empty())
    return {};
  std::vector<PagedBand> done;
  std::vector<PagedBand> open = {{0, height, {}}};
  while (!open.empty()) {
    PagedBand band = std::move(open.back());
    open.pop_back();
    Parts parts = parts_of(volumes, wanted_in(volumes, entries, band.bottom, band.top), entries.size());
    if (!parts.parts.empty()) {
      band.parts = std::move(parts.parts);
      done.push_back(std::move(band));
      continue;
    }
    const int rows = band.top - band.bottom;
    if (rows <= fewest_rows)
      throw LimitError("a single slice in " + std::to_string(rows) + " rows of the picture needs " +
                       std::to_string(parts.needed) + " bricks at once and render.memory holds " +
                       std::to_string(parts.capacity) + "; raise it, or make render.brick smaller");
    const int middle = band.bottom + rows / 2;
    open.push_back({middle, band.top, {}});
    open.push_back({band.bottom, middle, {}});
  }
  return done;
}

} // namespace slicelens
