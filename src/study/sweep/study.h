// A study as plain values: base scenes, the keys that vary, what every picture is compared with and how it is
// timed (docs/studies.md has the file's keys).
#pragma once

#include "scene/scene_json.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace slicelens {

/// A column of the results and what stands in it: {"render.spacing", "0.5"}. Texts without quotes, everything
/// else as JSON.
using Label = std::pair<std::string, std::string>;

/// One value of an axis.
struct SweepValue {
  std::vector<Label> labels;
  std::vector<KeyValue> changes;                   ///< of scene keys, in order; null: the default again
  std::optional<std::size_t> scene = std::nullopt; ///< one of Study::scenes in place of the first
};

/// What varies: axes are crossed with each other, the keys of one axis go together.
struct SweepAxis {
  std::vector<SweepValue> values; ///< at least one; all with the same columns
};

/// Holds where every column has one of its labels; the empty condition holds always.
using Condition = std::vector<std::pair<std::string, std::vector<std::string>>>;

/// A scene that a study starts from.
struct BaseScene {
  std::string name;             ///< empty for a single one
  std::string text;             ///< JSON with comments
  std::string source;           ///< in messages
  std::filesystem::path folder; ///< its relative paths count from here
};

/// What pictures are compared with: the combination's own scene, or one of its own, with changes.
struct ReferenceScene {
  std::optional<BaseScene> scene;
  std::vector<KeyValue> changes;
};

/// How frames are timed: in rounds, each of which visits every combination once in an order of its own.
struct TimingProtocol {
  bool measure = true;
  std::size_t warm_up = 1; ///< frames of a visit that do not count; at least one, which compiles the shaders
  std::size_t frames = 1;  ///< that count; the visit's time is their median
  std::size_t batch =
      1; ///< pictures that are drawn in a row for one of these frames: its time is theirs ÷ batch
  std::size_t rounds = 5;
  std::size_t most_rounds = 5; ///< where `precision` asks for more
  double confidence = 0.95;    ///< of the interval of the median
  double precision = 0; ///< rounds go on until half the interval is at most this part of the median; 0: off
  std::uint64_t seed = 2006;   ///< of the orders
  std::vector<Label> baseline; ///< what the baseline of a combination has in place of its own; empty: none
  bool beside = false;         ///< the baseline is timed at every visit, just before; else once a round
  std::vector<Condition> skip; ///< combinations that are not timed
  bool limits = true;          ///< measure the machine's fill rates in every round
};

/// Numbers that a paper printed, to stand beside ours.
struct PaperValues {
  std::string source;   ///< "LaMar 2001, Table 3, Onyx2"
  std::string quantity; ///< the column of the results that they compare with
  std::vector<std::pair<Condition, double>> values;
};

/// A chart that the report draws beside the usual ones.
struct StudyChart {
  std::string title;
  std::string x;               ///< a column of numbers, varied or measured
  std::string y;               ///< any column of numbers
  std::vector<std::string> by; ///< columns with a line for each of their labels; empty: all others
  bool logarithmic = false;
};

struct Study {
  std::string name; ///< the file's, without .json
  std::string title;
  std::string text; ///< what it shows, plain paragraphs
  std::vector<BaseScene> scenes;
  std::vector<KeyValue> set;
  std::vector<SweepAxis> axes;
  std::vector<Condition> except; ///< combinations that are left out
  std::optional<ReferenceScene> reference;
  std::vector<std::string> metrics; ///< names of study/metrics.h and study/lens_metrics.h
  TimingProtocol timing;
  std::vector<PaperValues> paper;
  std::vector<std::string> columns; ///< of the table in report and docs; empty: all
  std::vector<StudyChart> charts;
  std::string json;             ///< the study's whole text, comments removed, `quick` applied
  std::filesystem::path folder; ///< paths of the study's own keys count from here
};

struct StudyChoice {
  bool quick = false;             ///< apply the study's own `quick` part, a merge patch (RFC 7386)
  std::vector<KeyValue> set = {}; ///< after the study's `set`, before what varies
};

/// Reads a study. Throws UsageError naming `source`, key and value for malformed JSON, unknown keys (with the
/// nearest known one), empty lists, lists of one axis that differ in length, conditions on columns or labels
/// that no axis has, unknown metrics, and scene keys or values that no scene takes (scene_keys_from_json);
/// FileError for a base scene that cannot be read.
Study study_from_json(const std::string& text, const std::string& source, const std::filesystem::path& folder,
                      const StudyChoice& choice = {});

/// Reads the file. Throws as above, FileError where it cannot be read.
Study read_study(const std::filesystem::path& file, const StudyChoice& choice = {});

} // namespace slicelens
