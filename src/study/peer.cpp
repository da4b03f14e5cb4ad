#include "study/peer.h"

#include "core/errors.h"
#include "study/export.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <system_error>

namespace slicelens {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Sends a request and gives what is answered: an object without "error".
Json exchange(LineProcess& process, const Json& request, double limit) {
  const std::string line = process.ask(request.dump(-1, ' ', false, Json::error_handler_t::replace), limit);
  const Json answer = Json::parse(line, nullptr, false);
  if (!answer.is_object())
    process.fail("answered what is no JSON object: " + line.substr(0, 120));
  if (answer.contains("error")) {
    const Json& error = answer["error"];
    throw FileError(process.name(), error.is_string() ? error.get<std::string>() : error.dump());
  }
  return answer;
}

void require_ok(LineProcess& process, const Json& answer) {
  if (answer.value("ok", Json()) != Json(true))
    process.fail("answered neither \"ok\" nor an error: " + answer.dump().substr(0, 120));
}

std::string text_of(LineProcess& process, const Json& answer, const char* key) {
  const auto found = answer.find(key);
  if (found == answer.end() || !found->is_string())
    process.fail(std::string("answered without the text \"") + key + "\": " + answer.dump().substr(0, 120));
  return found->get<std::string>();
}

} // namespace

Peer::Peer(const fs::path& script, double limit) : process_(script, {"--serve"}), limit_(limit) {
  require_ok(process_, exchange(process_, {{"hello", true}}, limit_));
}

PeerDriver Peer::load(const fs::path& folder, const std::string& mapper) {
  const Json answer =
      exchange(process_, {{"load", fs::absolute(folder).string()}, {"mapper", mapper}}, limit_);
  require_ok(process_, answer);
  return {text_of(process_, answer, "renderer"), text_of(process_, answer, "version"),
          text_of(process_, answer, "vtk")};
}

void Peer::look(const PreparedScene& prepared) {
  require_ok(process_, exchange(process_, {{"camera", Json::parse(exported_camera(prepared))}}, limit_));
}

std::vector<double> Peer::draw(std::size_t frames) {
  if (frames == 0)
    throw UsageError("a peer draws at least one frame");
  const Json answer = exchange(process_, {{"draw", frames}}, limit_ * static_cast<double>(frames));
  std::vector<double> seconds;
  for (const Json& value : answer.value("seconds", Json::array())) {
    if (!value.is_number() || !std::isfinite(value.get<double>()) || value.get<double>() < 0)
      process_.fail("answered a time that is none: " + value.dump().substr(0, 120));
    seconds.push_back(value.get<double>());
  }
  if (seconds.size() != frames) {
    process_.fail("answered " + std::to_string(seconds.size()) + " times for " + std::to_string(frames) +
                  " frames: " + answer.dump().substr(0, 120));
  }
  return seconds;
}

void Peer::write(const fs::path& picture) {
  require_ok(process_, exchange(process_, {{"write", fs::absolute(picture).string()}}, limit_));
}

fs::path find_peer() {
  if (const char* named = std::getenv("SLICELENS_VTK"); named != nullptr && *named != '\0')
    return named;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  const std::string file = "render_with_vtk";
  const fs::path places[] = {program / SLICELENS_DATA_FROM_PROGRAM, SLICELENS_TOOLS_DIR};
  for (const fs::path& place : places) {
    if (fs::exists(place / file, error))
      return place / file;
  }
  throw FileError(file, "not found in " + places[0].lexically_normal().string() + " or " +
                            places[1].string() + "; name it with the environment variable SLICELENS_VTK");
}

} // namespace slicelens
