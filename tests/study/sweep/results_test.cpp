// From journal entries to tables, by hand; the journal's own faults.
#include "catch.h"
#include "core/errors.h"
#include "core/files.h"
#include "study/sweep/results.h"
#include "temporary_folder.h"

#include <sys/resource.h>

#include <csignal>

using namespace slicelens;

namespace {

const char* const study_text = R"({"vary": {"render.pipeline": ["slices", "rays"]},
  "timing": {"rounds": 3, "baseline": {"render.pipeline": "slices"}},
  "paper": [{"source": "a paper", "quantity": "rate", "values": [{"when": {"render.pipeline": "rays"}, "value": 0.5}]}]})";

TimedVisit visit(const std::string& id, std::size_t shard, std::size_t round, double draw) {
  return {id, shard, round, {{"draw", draw}, {"draw_processor", 2 * draw}}};
}

/// Slices took 2, 2 and 4 seconds, rays 1, 4 and 4 in the same rounds.
JournalContents measured() {
  JournalContents journal;
  journal.qualities = {
      {"a", "x", {{"psnr", 40.0}, {"fragments", 1000.0}}, {}},
      {"b", "x", {{"psnr", std::nullopt}, {"samples", 1000.0}}, {{"renderer", "one, \"two\""}}}};
  journal.visits = {visit("a", 1, 0, 2),
                    visit("a", 1, 1, 2),
                    visit("a", 1, 2, 4),
                    visit("b", 1, 2, 4),
                    visit("b", 1, 0, 1),
                    visit("b", 1, 1, 4),
                    {"limits", 1, 0, {{"classified", 1000.0}}},
                    {"limits", 1, 1, {{"classified", 2000.0}}},
                    {"limits", 1, 2, {{"classified", 3000.0}}}};
  return journal;
}

StudyResults collected(const JournalContents& journal, const std::string& error = "") {
  const Study study = study_from_json(study_text, "test.json", ".");
  return collect(study, combinations_of(study), {CombinationState{"a", "x"}, CombinationState{"b", "x"}},
                 {"", error}, journal);
}

} // namespace

TEST_CASE("times are medians and quartiles of the rounds, rates go pair by pair") {
  const StudyResults results = collected(measured());
  const Row& slices = results.rows[0];
  const Row& rays = results.rows[1];
  REQUIRE(slices.status == RowStatus::done);
  REQUIRE(number_in(results, slices, "draw_s") == 2.0);
  REQUIRE(number_in(results, rays, "draw_s") == 4.0);
  REQUIRE(number_in(results, rays, "draw_s_q1") == 2.5);
  REQUIRE(number_in(results, rays, "draw_s_min") == 1.0);
  REQUIRE(number_in(results, rays, "draw_s_n") == 3.0);
  // of 1, 4, 4: mean 3, squares 4 + 1 + 1, divided by n − 1 = 2
  REQUIRE(*number_in(results, rays, "draw_s_sd") == Approx(std::sqrt(3.0)));
  // Round by round 2/1, 2/4, 4/4; the ratio of the medians would be 1/2.
  REQUIRE(rays.rate->values == std::vector<double>{2, 0.5, 1});
  REQUIRE(number_in(results, rays, "rate") == 1.0);
  REQUIRE(number_in(results, rays, "processor_rate_q1") == 0.75);
  REQUIRE(number_in(results, slices, "rate") == 1.0);
  // 1000 fragments in 2 s, beside a machine that can do 2000 a second.
  REQUIRE(number_in(results, slices, "fragments_per_s") == 500.0);
  REQUIRE(number_in(results, slices, "of_limit") == 0.25);
  REQUIRE(number_in(results, rays, "samples_per_s") == 250.0);
  REQUIRE(number_in(results, rays, "a paper") == 0.5);
  REQUIRE_FALSE(number_in(results, slices, "a paper").has_value());
}

TEST_CASE("a picture whose warp changes is slower by deforming and slicing it anew") {
  JournalContents journal = measured();
  for (TimedVisit& timed : journal.visits) {
    if (timed.id == "a")
      timed.seconds.insert(timed.seconds.end(), {{"deform", 1.0}, {"slice", 0.75}, {"tessellate", 0.25}});
  }
  const StudyResults results = collected(journal);
  REQUIRE(number_in(results, results.rows[0], "changed_rate") == 0.5); // 2/(2 + 1 + .75 + .25)
  REQUIRE_FALSE(number_in(results, results.rows[1], "changed_rate").has_value());
}

TEST_CASE("a baseline that was timed beside a visit counts before that of the round") {
  JournalContents journal = measured();
  journal.visits[3].seconds.emplace_back("baseline_draw", 6.0); // rays, round 2, 4 seconds
  const StudyResults results = collected(journal);
  REQUIRE(results.rows[1].rate->values == std::vector<double>{2, 0.5, 1.5});
  for (const auto& [phase, spread] : results.rows[1].seconds)
    REQUIRE(phase.rfind("baseline", 0) != 0);
}

TEST_CASE("visits of another shard are no baseline") {
  JournalContents journal = measured();
  for (TimedVisit& one : journal.visits) {
    if (one.id == "a")
      one.shard = 2;
  }
  const StudyResults results = collected(journal);
  REQUIRE_FALSE(results.rows[1].rate.has_value());
  journal.visits.push_back(visit("a", 1, 1, 8)); // the other shard's own measurement of the baseline
  REQUIRE(collected(journal).rows[1].rate->values == std::vector<double>{2});
}

TEST_CASE("rows that lack a round, a picture or fail are not done") {
  JournalContents journal = measured();
  journal.visits.erase(journal.visits.begin());
  REQUIRE(collected(journal).rows[0].status == RowStatus::missing);
  journal = measured();
  journal.qualities[1].of = "another reference";
  REQUIRE(collected(journal).rows[1].status == RowStatus::missing);
  const StudyResults failed = collected(measured(), "no room");
  REQUIRE(failed.rows[1].status == RowStatus::failed);
  REQUIRE(cell(failed, failed.rows[1], "error") == "no room");
}

TEST_CASE("CSV quotes what needs it and leaves unknown cells empty") {
  const std::string csv = results_csv(collected(measured()));
  REQUIRE(csv.rfind("index,render.pipeline,status,psnr", 0) == 0);
  REQUIRE(csv.find("\n1,rays,done,,") != std::string::npos);
  REQUIRE(csv.find("\"one, \"\"two\"\"\"") != std::string::npos);
}

TEST_CASE("a journal keeps what it has, drops half a line and refuses another study") {
  const TemporaryFolder folder;
  const auto file = folder / "journal.jsonl";
  {
    Journal journal(file, {"study", "machine"});
    journal.add(measured().qualities[0]);
    journal.add(measured().visits[0]);
    REQUIRE_THROWS_AS(Journal(file, {"study", "machine"}), FileError); // held by the first
  }
  const std::string whole = read_text(file);
  folder.put("journal.jsonl", whole + "{\"kind\": \"vis");
  {
    const Journal journal(file, {"study", "machine"});
    REQUIRE(journal.contents().qualities.size() == 1);
    REQUIRE(journal.contents().qualities[0].values == measured().qualities[0].values);
    REQUIRE(journal.contents().visits.size() == 1);
    REQUIRE(journal.contents().visits[0].seconds == measured().visits[0].seconds);
  }
  REQUIRE(read_text(file) == whole);
  REQUIRE_THROWS_AS(Journal(file, {"another", "machine"}), FileError);
  REQUIRE_THROWS_AS(Journal(file, {"study", "another"}), FileError);
  folder.put("journal.jsonl", whole + "not an entry\n");
  REQUIRE_THROWS_AS(Journal(file, {"study", "machine"}), FileError);
  REQUIRE_THROWS_AS(Journal(folder / "none" / "journal.jsonl", {"study", "machine"}), FileError);
}

TEST_CASE("a full disk loses no entry") {
  const TemporaryFolder folder;
  const auto file = folder / "journal.jsonl";
  Journal journal(file, {"study", "machine"});
  journal.add(measured().visits[0]);
  const std::string before = read_text(file);
  // No file may grow beyond ten bytes more: what a full disk does, without filling one.
  struct rlimit old {};
  REQUIRE(::getrlimit(RLIMIT_FSIZE, &old) == 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  struct rlimit small = old;
  small.rlim_cur = before.size() + 10;
  REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
  bool refused = false;
  try {
    journal.add(measured().visits[1]);
  } catch (const FileError&) {
    refused = true;
  }
  ::setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, handler);
  REQUIRE(refused);
  REQUIRE(read_text(file) == before);
  journal.add(measured().visits[1]); // there is room again
  REQUIRE(read_journal(file).visits.size() == 2);
}
