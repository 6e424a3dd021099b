// SPDX-License-Identifier: MIT
#include "Report.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "Base64.h"
#include "Bcf.h"
#include "Clash.h"
#include "ClashPicture.h"
#include "Commands.h"
#include "Png.h"
#include "Since.h"
#include "WritePage.h"
#include "allpairs/parallel/TbbExecutor.h"
#include "allpairs/scene/BoxFrames.h"
#include "allpairs/scene/FileError.h"
#include "cli/Arguments.h"
#include "cli/ExitStatus.h"
#include "cli/Options.h"
#include "cli/Progress.h"
#include "cli/Terminal.h"
#include "cli/Text.h"
#include "detect/Exact.h"
#include "input/Inputs.h"
#include "report/ReportFolder.h"
#include "view/MakeViewScene.h"
#include "view/OpenFile.h"
#include "view/ViewFrames.h"
#include "view/ViewRequest.h"

namespace allpairs::app {
namespace {

/// A hundred light years, and no box of that many becomes infinite.
constexpr double kMostMetres = 1e18;

constexpr const char* kNoShapes = "--fail-on clash is of shapes, and none were tested; --exact tests them";

struct ReportSettings {
  InputSettings input;
  ViewArguments view;
  std::string folder;
  std::size_t pictures = 500;
  std::optional<double> metresPerUnit;
  std::string bcf = "2.1";
  std::string since;
  bool force = false;
  std::string failOn;
  bool open = false;
};

constexpr const char* kReportExamples = R"(The folder gets index.html, view.html (in 3D), clashes.csv, clashes.bcf
(for BIM tools) and a folder of pictures. Shapes are tested where the input has any: clashes come
first, the worst before all, and pairs that are apart are only counted. Of SOFA scenes,
and with --boxes, all pairs of boxes are listed, those with the largest shared volume
first. A scene with several collision pipelines is for detect only.

Examples:
  allpairs report parts/ -o report
  allpairs report assembly.glb --clearance 0.01 -o report --pictures 100
  allpairs report parts/ --metres-per-unit 0.001 -o report
  allpairs report structure.ifc pipes.ifc --between-inputs -o report
  allpairs report building.ifc --since monday -o tuesday --bcf 3.0)";

/// The report that this one is compared with.
struct Earlier {
  std::string name;
  std::vector<view::EarlierClash> rows;
};

/// Now, or the moment that builds which must repeat exactly give in SOURCE_DATE_EPOCH.
std::string dateText() {
  std::time_t moment = std::time(nullptr);
  if (const char* fixed = std::getenv("SOURCE_DATE_EPOCH")) {
    constexpr long long kYear0 = -62167219200;
    constexpr long long kYear10000 = 253402300800;
    const auto seconds = numberOf<long long>(fixed);
    if (!seconds || *seconds < kYear0 || *seconds >= kYear10000)
      throw UsageError("SOURCE_DATE_EPOCH: '" + std::string(fixed) +
                       "' is no moment of the years 0 to 9999, in seconds since 1970");
    moment = static_cast<std::time_t>(*seconds);
  }
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(moment));
}

/// Painters that work at the same time; each picture borrows one.
class Painters {
 public:
  explicit Painters(const view::ViewScene& scene) : m_scene(scene) {}

  std::string picture(const view::Clash& clash, const view::Overview& overview) {
    std::unique_ptr<view::ClashPainter> painter = borrow();
    view::Raster& picture = painter->paint(clash, view::cameraOf(m_scene, clash));
    overview.addTo(picture, view::placeOf(m_scene, clash));
    std::string bytes = view::encodePng(picture);
    const std::lock_guard lock(m_mutex);
    m_free.push_back(std::move(painter));
    return bytes;
  }

 private:
  std::unique_ptr<view::ClashPainter> borrow() {
    const std::lock_guard lock(m_mutex);
    if (m_free.empty()) return std::make_unique<view::ClashPainter>(m_scene);
    std::unique_ptr<view::ClashPainter> painter = std::move(m_free.back());
    m_free.pop_back();
    return painter;
  }

  const view::ViewScene& m_scene;
  std::mutex m_mutex;
  std::vector<std::unique_ptr<view::ClashPainter>> m_free;
};

/// The pictures of the first clashes as PNG files, by number.
std::vector<std::string> drawPictures(const view::ViewScene& scene, std::span<const view::Clash> clashes,
                                      std::size_t threads) {
  constexpr std::size_t kTogether = 16;  // pictures; then the line shows how far it is
  ProgressLine line;
  parallel::TbbExecutor executor(threads);
  std::vector<std::string> pictures(clashes.size());
  if (clashes.empty()) return pictures;
  const view::Overview overview(scene);
  Painters painters(scene);
  for (std::size_t begin = 0; begin < clashes.size(); begin += kTogether) {
    line.show(begin, clashes.size(), fmt::format("drawing {} of {}", begin + 1, clashes.size()));
    executor.run(std::min(kTogether, clashes.size() - begin),
                 [&](std::size_t i) { pictures[begin + i] = painters.picture(clashes[begin + i], overview); });
  }
  return pictures;
}

std::string bcfOf(const view::ViewScene& scene, std::span<const view::Clash> pictured,
                  const std::vector<std::string>& pictures, view::BcfOptions options) {
  options.picture = [&pictures](const view::Clash& clash) { return pictures[clash.number - 1]; };
  return view::makeBcf(scene, pictured, options);
}

/// The page beside the report, or why there is none.
struct ScenePage {
  std::string bytes;
  std::string problem;
};

ScenePage pageOf(const view::ViewScene& scene) {
  ScenePage page;
  try {
    view::writePage(scene, [&page](std::string_view bytes) { page.bytes += bytes; });
  } catch (const Error& problem) {  // too much for a page is not too much for a report
    page = {"", problem.what()};
  }
  return page;
}

std::string unitOf(const ReportSettings& settings, const view::ViewScene& scene) {
  if (settings.metresPerUnit) return view::unitText(*settings.metresPerUnit) + ", as --metres-per-unit says";
  if (scene.metresPerUnit) return view::unitText(*scene.metresPerUnit) + ", as the input says";
  return "those of the input, which does not say how long they are";
}

std::vector<view::ReportFact> factsOf(const ReportSettings& settings, const view::ViewScene& scene,
                                      const std::string& date) {
  const std::map<std::string, std::string> rows{{"body", "pairs of bodies"},
                                                {"assembly", "pairs of assemblies"},
                                                {"file", "pairs of files"},
                                                {"none", "pairs of models"}};
  std::vector<view::ReportFact> facts{{"Made", date}, {"By", "allpairs " ALLPAIRS_VERSION}};
  facts.push_back({"Input", scene.title});
  facts.push_back({"Tested", scene.isExact ? "shapes" : "boxes"});
  if (settings.view.search.distance) facts.push_back({"Distance", view::shortNumber(scene.distance)});
  if (scene.isExact) facts.push_back({"Clearance", view::shortNumber(scene.clearance)});
  facts.push_back({"Rows", rows.at(settings.view.group)});
  if (settings.input.betweenInputs) facts.push_back({"Left out", "pairs within one input"});
  facts.push_back({"Lengths", unitOf(settings, scene)});
  facts.push_back({"Up", std::string(scene.up < 0 ? "-" : "") + "xyz"[std::abs(scene.up) - 1]});
  return facts;
}

/// clashes.bcf as a script that hands it to the page: a page that is a file may not read another file, but may run it.
void writeBcfScript(const std::string& bcf, scene::ByteSink sink) {
  sink("allpairsBcf(\"");
  view::writeBase64(bcf, sink);
  sink("\");\n");
}

/// How many rows are what --fail-on names: any, clashes, or new clashes, where shapes were tested.
std::size_t countFound(const std::vector<view::Clash>& clashes, const std::string& failOn) {
  const auto isFound = [&failOn](const view::Clash& clash) {
    const bool isClash = clash.exact == nullptr || allpairs::isClash(clash.exact->state);
    return failOn == "pair" || (isClash && (failOn == "clash" || clash.since == view::Change::New));
  };
  return failOn.empty() ? 0 : static_cast<std::size_t>(std::count_if(clashes.begin(), clashes.end(), isFound));
}

/// Draws everything before the first file is written, so that what goes wrong on the way leaves nothing behind. Returns
/// how many rows are what --fail-on names.
std::size_t writeReport(const view::ViewScene& scene, const ReportSettings& settings, const std::string& date,
                        const std::optional<Earlier>& earlier) {
  std::vector<view::Clash> clashes = view::clashesOf(scene);
  std::optional<view::Since> since;
  if (earlier) since = view::compareWith(earlier->rows, earlier->name, scene, clashes);
  const auto pictured = std::span(clashes).first(std::min(clashes.size(), settings.pictures));
  const std::vector<std::string> pictures = drawPictures(scene, pictured, parseThreads(settings.view.threads));
  view::BcfOptions options;
  options.version = settings.bcf == "3.0" ? view::BcfVersion::V30 : view::BcfVersion::V21;
  options.metresPerUnit = settings.metresPerUnit.value_or(scene.metresPerUnit.value_or(1.0));
  if (since) options.gone = since->gone;
  options.date = date;
  const std::string bcf = bcfOf(scene, pictured, pictures, options);
  const ScenePage page = pageOf(scene);
  const view::Report report{
      scene, clashes, pictured.size(), since ? &*since : nullptr, factsOf(settings, scene, date), page.problem};
  ReportFolder folder(settings.folder);
  for (const view::Clash& clash : pictured) folder.write(view::pictureName(clash.number), pictures[clash.number - 1]);
  folder.write("clashes.bcf", bcf);
  folder.write("clashes.bcf.js", [&](scene::ByteSink sink) { writeBcfScript(bcf, sink); });
  if (page.problem.empty()) folder.write("view.html", page.bytes);
  folder.write("clashes.csv", [&](scene::ByteSink sink) { view::writeReportCsv(report, sink); });
  folder.write("index.html",  // last, so that what it refers to is there
               [&](scene::ByteSink sink) { view::writeReportPage(report, sink); });
  folder.commit(pictured.size(), page.problem.empty());
  const std::string changes = since ? " (" + view::countText(*since) + ')' : "";
  sayWritten(view::headlineOf(scene) + changes, std::filesystem::path(settings.folder) / "index.html");
  return countFound(clashes, settings.failOn);
}

/// The earlier report, by its folder or its table; before the work, and before a report in the same folder replaces it.
std::optional<Earlier> readEarlier(const std::string& path) {
  if (path.empty()) return std::nullopt;
  std::error_code ignored;
  const bool isFolder = std::filesystem::is_directory(path, ignored);
  const std::filesystem::path table =
      isFolder ? std::filesystem::path(path) / "clashes.csv" : std::filesystem::path(path);
  if (std::filesystem::is_directory(table, ignored)) throw FileError(table, "is a folder, not a file");
  std::ifstream stream(table, std::ios::binary);
  if (const int reason = errno; !stream && reason != ENOENT)
    throw FileError::ofSystem(table, "cannot be opened", {reason, std::generic_category()});
  if (!stream) throw FileError(path, "holds no report to compare with: there is no clashes.csv");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  try {
    return Earlier{path, view::readReportCsv(text)};
  } catch (const Error& problem) {
    throw FileError(table, problem.what());
  }
}

/// Before the work, too.
void checkIsOneFrame(const std::vector<std::string>& paths) {
  if (paths.size() != 1 || !isAnyBoxFrames(paths) || scene::BoxFrames(paths.front()).frameCount() < 2) return;
  throw UsageError("a report shows one frame, and the input has several: 'allpairs view' shows them");
}

/// Before the work, too, where the names of the inputs say that no shapes are tested.
void checkFailOn(const ReportSettings& settings, const ViewRequest& request) {
  if (settings.failOn != "clash") return;
  requireExact();
  const bool haveNoShapes = areScenes(settings.input) || areBoxArrays(settings.input);
  if (request.shapes == ShapeTest::WhereShapesAre && haveNoShapes) throw UsageError(kNoShapes);
}

void runReport(const ReportSettings& settings) {
  if (settings.folder.empty()) throw UsageError("no -o DIR given: the folder to write to");
  if (settings.folder == "-") throw UsageError("-o: a report is a folder, for which '-' is no name");
  if (settings.failOn == "clash" && settings.view.boxes)
    throw UsageError("--fail-on clash is of shapes, which --boxes does not test");
  if (settings.failOn == "new" && settings.since.empty()) throw UsageError("--fail-on new compares: add --since");
  if (const double length = settings.metresPerUnit.value_or(1.0); !(length > 0.0) || length > kMostMetres) {
    throw UsageError("--metres-per-unit must be above 0 and at most 1e18");
  }
  checkOutputs(settings.input);
  checkReportFolder(settings.folder, settings.force);
  const std::string date = dateText();
  const std::optional<Earlier> earlier = readEarlier(settings.since);
  checkIsOneFrame(settings.input.paths);
  const ViewRequest request = viewRequest(settings.view);
  checkFailOn(settings, request);
  const view::ViewScene scene = makeViewScene(settings.input, request);
  if (settings.failOn == "clash" && !scene.isExact) throw UsageError(kNoShapes);
  const std::size_t found = writeReport(scene, settings, date, earlier);
  const std::filesystem::path page = std::filesystem::absolute(std::filesystem::path(settings.folder) / "index.html");
  if (settings.open && found == 0) openInBrowser(page);
  if (settings.open && found != 0) tryToOpen(page);  // what was found is the status, whether or not a browser shows it
  const std::string word = settings.failOn == "new" ? "new row" : settings.failOn == "pair" ? "row" : "row of clashes";
  const std::string words = settings.failOn == "clash" ? "rows of clashes" : word + 's';
  if (found != 0) throw Found(counted(found, word, words));
}

}  // namespace

void addReport(CLI::App& program) {
  const auto settings = std::make_shared<ReportSettings>();
  CLI::App* command =
      program.add_subcommand("report", "Write a folder with a page, a table and a BCF file of the pairs");
  command->footer(kReportExamples);
  addInputs(*command, settings->input);
  addBetweenInputs(*command, settings->input);
  addViewOptions(*command, settings->view);
  command->add_option("-o,--output", settings->folder, "Write to the folder DIR; it is created if missing")
      ->type_name("DIR");
  command->add_flag("--force", settings->force, "Write to DIR although it holds other files");
  addChoice(*command, "--bcf", settings->bcf, {"2.1", "3.0"})
      ->description("Version of clashes.bcf")
      ->capture_default_str();
  command
      ->add_option(
          "--since", settings->since,
          "Compare with an earlier report: its folder, or its clashes.csv; rows are new, persisting or resolved")
      ->type_name("LAST");
  addChoice(*command, "--fail-on", settings->failOn, {"pair", "clash", "new"})
      ->description("End with status 4 if there is a pair, a clash, or one that is new since --since");
  command->add_flag("--open", settings->open, "Open the report in the browser");
  takeCount(
      *command->add_option("--pictures", settings->pictures, "Number of pairs with a picture and a BCF topic, at most")
           ->type_name("N")
           ->capture_default_str());
  command
      ->add_option("--metres-per-unit", settings->metresPerUnit,
                   "Length of a unit of the input, for BCF's cameras; by default as the format says, else 1")
      ->type_name("M");
  command->callback([settings] {
    settings->input.outputs = filesOfReport(settings->folder);
    withInputs(settings->input, [settings] { runReport(*settings); });
  });
}

}  // namespace allpairs::app
