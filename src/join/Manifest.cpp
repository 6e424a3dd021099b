// SPDX-License-Identifier: MIT
#include "Manifest.h"

#include <bit>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <utility>

#include "Checksum.h"
#include "WorkFile.h"
#include "allpairs/Error.h"
#include "allpairs/scene/FileError.h"

namespace allpairs::join {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr int kVersion = 1;  // of the form of the file

/// A double as its bits: JSON has no infinities.
std::uint64_t bitsOf(double value) { return std::bit_cast<std::uint64_t>(value); }
double ofBits(const Json& bits) { return std::bit_cast<double>(bits.get<std::uint64_t>()); }

Json inputsOf(const Manifest& manifest) {
  Json inputs = Json::array();
  for (const InputState& input : manifest.inputs) inputs.push_back({input.path, input.bytes, input.changed});
  return inputs;
}

Json cutsOf(const Manifest& manifest) {
  Json cuts = Json::array();
  for (const partition::Cut& cut : manifest.cuts) cuts.push_back({bitsOf(cut.at), cut.axis, cut.low, cut.high});
  return cuts;
}

Json extentsOf(const Manifest& manifest) {
  Json extents = Json::array();
  for (const Extent& extent : manifest.extents) extents.push_back({extent.begin, extent.count, extent.checksum});
  return extents;
}

Json cellsOf(const Manifest& manifest) {
  Json cells = Json::array();
  for (const auto& [number, result] : manifest.cells) {
    Json runs = Json::array();
    for (const Run& run : result.runs) runs.push_back({run.position, run.pairs, run.checksum});
    cells.push_back({number, result.pairs, std::move(runs)});
  }
  return cells;
}

std::string textOf(const Manifest& manifest) {
  return Json({{"version", kVersion},
               {"inputs", inputsOf(manifest)},
               {"distance", bitsOf(manifest.distance)},
               {"count", manifest.isCount},
               {"cuts", cutsOf(manifest)},
               {"extents", extentsOf(manifest)},
               {"cells", cellsOf(manifest)}})
      .dump();
}

Manifest manifestOf(const std::string& text) {
  const Json json = Json::parse(text);
  Manifest manifest;
  if (json.at("version") != kVersion) throw InvalidArgument("it is of another version");
  for (const Json& input : json.at("inputs")) manifest.inputs.push_back({input.at(0), input.at(1), input.at(2)});
  manifest.distance = ofBits(json.at("distance"));
  manifest.isCount = json.at("count");
  for (const Json& cut : json.at("cuts")) manifest.cuts.push_back({ofBits(cut.at(0)), cut.at(1), cut.at(2), cut.at(3)});
  for (const Json& extent : json.at("extents")) {
    manifest.extents.push_back({extent.at(0), extent.at(1), extent.at(2)});
  }
  for (const Json& cell : json.at("cells")) {
    CellResult& result = manifest.cells[cell.at(0)];
    result.pairs = cell.at(1);
    for (const Json& run : cell.at(2)) result.runs.push_back({run.at(0), run.at(1), run.at(2)});
  }
  return manifest;
}

std::uint64_t checksumOf(const std::string& text) {
  Checksum checksum;
  checksum.add(text.data(), text.size());
  return checksum.value();
}

std::string checksumLine(const std::string& text) { return '\n' + std::to_string(checksumOf(text)) + '\n'; }

}  // namespace

void Manifest::write(const fs::path& path) const {
  std::string text = textOf(*this);
  text += checksumLine(text);
  const fs::path next = path.string() + ".next";
  WorkFile(next, WorkFile::Mode::Create).write(0, text.data(), text.size());
  std::error_code problem;
  fs::rename(next, path, problem);
  if (problem) throw FileError(path, "cannot be replaced: " + problem.message());
}

std::optional<Manifest> Manifest::read(const fs::path& path) {
  if (!fs::exists(path)) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  const std::string all{std::istreambuf_iterator<char>(file), {}};
  const std::string text = all.substr(0, all.find('\n'));
  if (all != text + checksumLine(text)) throw FileError(path, "is damaged: remove its folder and join anew");
  try {
    return manifestOf(text);
  } catch (const std::exception& problem) {
    throw FileError(path, std::string("cannot be used: remove its folder and join anew (") + problem.what() + ")");
  }
}

std::vector<InputState> statesOf(std::span<const fs::path> paths) {
  std::vector<InputState> states;
  for (const fs::path& path : paths) {
    states.push_back({checksumOf(fs::absolute(path).lexically_normal().string()), fs::file_size(path),
                      fs::last_write_time(path).time_since_epoch().count()});
  }
  return states;
}

}  // namespace allpairs::join
