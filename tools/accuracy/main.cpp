// The program that measures what docs/accuracy.md says: renderers against formulas, against each other, and
// what precision costs. Tables in Markdown on stdout, progress on stderr.

#include "bench.h"
#include "core/errors.h"

#include <CLI/CLI.hpp>

#include <ctime>
#include <iostream>
#include <thread>

namespace slicelens::accuracy {

namespace {

struct Section {
  const char* name;
  void (*run)(const Bench&);
};

const std::vector<Section>& sections() {
  static const std::vector<Section> list = {{"closed-forms", closed_form_section},
                                            {"modes", mode_section},
                                            {"parity", parity_section},
                                            {"perspective", perspective_section},
                                            {"precision", precision_section},
                                            {"opacity", opacity_section},
                                            {"filters", filter_section},
                                            {"axis", axis_section},
                                            {"gradients", gradient_section},
                                            {"footprint", footprint_section},
                                            {"grids", grid_section},
                                            {"preintegrated", preintegrated_section},
                                            {"vessels", vessel_section},
                                            {"skip", skip_section}};
  return list;
}

std::vector<std::string> section_names() {
  std::vector<std::string> names;
  for (const Section& section : sections())
    names.emplace_back(section.name);
  return names;
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  char text[32];
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::strftime(text, sizeof text, "%Y-%m-%d", &utc);
  return text;
}

void run(const std::string& volumes, const std::vector<std::string>& wanted) {
  std::vector<Section> chosen;
  for (const Section& section : sections()) {
    if (wanted.empty() || std::find(wanted.begin(), wanted.end(), section.name) != wanted.end())
      chosen.push_back(section);
  }
  if (!volumes.empty() && !std::filesystem::is_directory(volumes))
    throw FileError(volumes, "is not a folder; --volumes takes the folder with the real volumes");
  gl::Context context = gl::open_context(gl::ContextKind::automatic);
  const gl::ContextInfo& info = context.info();
  std::cout << "Measured on " << today() << " by `slicelens_accuracy"
            << (volumes.empty() ? "" : " --volumes DIR");
  for (const std::string& name : wanted)
    std::cout << " " << name;
  std::cout << "`, Slicelens " << SLICELENS_VERSION << ", driver " << info.renderer << ", OpenGL "
            << info.version << ", " << std::thread::hardware_concurrency() << " processor cores.\n\n";
  for (const Section& section : chosen)
    section.run({context, volumes});
}

} // namespace

} // namespace slicelens::accuracy

int main(int argc, char** argv) {
  CLI::App app("Measures the accuracy of Slicelens' renderers; Markdown tables on stdout.");
  std::string volumes;
  std::vector<std::string> wanted;
  app.add_option("--volumes", volumes,
                 "folder with real volumes (ct_chest_large/series, cthead_png16/slices, "
                 "engine/engine.vti, bonsai/bonsai.nii.gz, aneurism/aneurism.vti); those present are used")
      ->type_name("DIR");
  app.add_option("sections", wanted, "which; all by default")
      ->check(CLI::IsMember(slicelens::accuracy::section_names()));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    slicelens::accuracy::run(volumes, wanted);
    return 0;
  } catch (const slicelens::UsageError& error) {
    std::cerr << "slicelens_accuracy: " << error.what() << std::endl;
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "slicelens_accuracy: " << error.what() << std::endl;
    return 1;
  }
}
