// The folder that a study writes.
#pragma once

#include "study/sweep/results.h"

#include <filesystem>

namespace slicelens {

/// Makes the folder with its places for pictures. Throws FileError.
void make_folders(const std::filesystem::path& folder);

/// Renames a journal to the first free of journal-1.jsonl, journal-2.jsonl …; nothing where there is none.
void put_aside(const std::filesystem::path& journal);

/// Writes study.json, results.csv, results.json and report.html, each whole or not at all. Throws FileError.
void write_results(const StudyResults& results, const std::filesystem::path& folder);

/// Copies the pictures of another study's folder. Throws FileError.
void copy_pictures(const std::filesystem::path& from, const std::filesystem::path& to);

} // namespace slicelens
