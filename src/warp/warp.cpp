#include "warp/warp.h"

namespace slicelens {

namespace {

struct KindName {
  std::string operator()(const LamarLens&) const { return "lamar"; }
};

} // namespace

std::string kind_of(const Warp& warp) { return std::visit(KindName{}, warp); }

const std::vector<WarpInfo>& warp_infos() {
  static const std::vector<WarpInfo> infos = {
      {"lamar",
       "magnification lens with tessellated borders (LaMar, Hamann and Joy 2001)",
       {"tessellated", "fragment", "fixed-function", "rays", "reference"}},
  };
  return infos;
}

std::optional<Warp> make_warp(const std::string& kind) {
  if (kind == "lamar")
    return LamarLens{};
  return std::nullopt;
}

void validate(const Warp& warp) {
  std::visit([](const auto& value) { validate(value); }, warp);
}

} // namespace slicelens
