// SPDX-License-Identifier: MIT
#include "Report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "Text.h"

namespace allpairs::view {
namespace {

constexpr const char* kStyle = R"(
:root{color-scheme:light dark;--ink:light-dark(#1a2129,#e6ebf0);--soft:light-dark(#5a6672,#9aa7b4);
--line:light-dark(#d6dce2,#323b45);--paper:light-dark(#fff,#1c2229);--ground:light-dark(#f4f6f8,#14181d)}
*{box-sizing:border-box}body{margin:0;background:var(--ground);color:var(--ink);
font:1rem/1.45 system-ui,-apple-system,"Segoe UI","DejaVu Sans",sans-serif}
main{max-width:90rem;margin:0 auto;padding:1.5rem}h1{margin:0;overflow-wrap:anywhere}
p{color:var(--soft);max-width:60rem}.headline{color:var(--ink);font-size:1.6rem;font-weight:600;line-height:1.25;
margin:.6rem 0 .3rem}.worst{color:var(--ink);margin:.3rem 0}
.state{display:inline-block;border-radius:.3rem;padding:0 .4rem;font-size:.85em;font-weight:600;color:#fff;background:#5a6672}
.state.duplicate{background:#7a0f5a}.state.contained{background:#a3123a}.state.clash{background:#c2330f}
.state.new{background:#1d6b34}.state.touching{background:#7d6e00}.state.clearance{background:#1f6f8b}
.clashes{display:grid;gap:1rem;
grid-template-columns:repeat(auto-fill,minmax(min(20rem,100%),1fr))}
figure{margin:0;background:var(--paper);border:1px solid var(--line);border-radius:.5rem;overflow:hidden}
figure img{display:block;width:100%;height:auto;aspect-ratio:4/3}figcaption{padding:.6rem .9rem;overflow-wrap:anywhere}
.first,.second{font-weight:600}.first::before,.second::before{content:"";display:inline-block;width:.7em;height:.7em;
border-radius:50%;margin-right:.4em;background:#0072b2}.second::before{background:#e69f00}
.fact{color:var(--soft);font-variant-numeric:tabular-nums}.scroll{overflow-x:auto}
details{margin-top:.4rem;color:var(--soft)}summary{cursor:pointer}details ul{margin:.3rem 0;padding-left:1.2rem}
table{border-collapse:collapse;background:var(--paper);margin-top:1rem;min-width:100%}
th,td{text-align:left;padding:.3rem .8rem;border-bottom:1px solid var(--line);overflow-wrap:anywhere}
td.number,th.number{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
@media print{figure{break-inside:avoid}}
)";

constexpr std::size_t kMostRows = 10'000;  // of more, browsers take seconds to lay out the page

/// The class and the GlobalId of a model that has them.
std::string kindOf(const ViewScene& scene, const Clash& clash, std::uint32_t model) {
  if (scene.ids.empty() || !clash.inside.empty() || scene.ids[model].empty()) return {};
  return fmt::format("<br><span class=\"fact\">{} {}</span>", escapeHtml(scene.kinds[model]),
                     escapeHtml(scene.ids[model]));
}

std::string namesOf(const ViewScene& scene, const Clash& clash) {
  std::string text = fmt::format("<span class=\"first\">{}</span>", escapeHtml(firstNameOf(scene, clash)));
  text += kindOf(scene, clash, clash.first);
  if (clash.isSelf()) return text + " with itself";
  text += fmt::format("<br><span class=\"second\">{}</span>", escapeHtml(secondNameOf(scene, clash)));
  return text + kindOf(scene, clash, clash.second);
}

/// The state as a word with a colour, and whether it is new.
std::string badgeOf(const Clash& clash) {
  std::string text;
  if (clash.isNew)
    text = *clash.isNew ? "<span class=\"state new\">new</span> " : "<span class=\"state\">persisting</span> ";
  if (clash.exact == nullptr) return text;
  const std::string_view name = stateName(clash.exact->state);
  return fmt::format("<span class=\"state {}\">{}</span> ", name, name) + text;
}

/// The pairs of a row's bodies, to be opened.
std::string partsOf(const ViewScene& scene, const Clash& clash) {
  constexpr std::size_t kMostListed = 20;
  if (clash.inside.empty()) return {};
  const auto item = [&scene](const Clash& pair) {
    const std::string second = pair.isSelf() ? "itself" : scene.name(pair.second);
    return fmt::format("<li>{}{} and {}: {}</li>", badgeOf(pair), escapeHtml(scene.name(pair.first)),
                       escapeHtml(second), escapeHtml(findingOf(scene, pair)));
  };
  std::string text = fmt::format("<details><summary>{} pairs of their parts</summary><ul>", clash.inside.size() + 1);
  text += item(clash);
  const std::size_t listed = std::min(clash.inside.size(), kMostListed);
  for (const Clash& pair : std::span(clash.inside).first(listed)) text += item(pair);
  if (listed < clash.inside.size())
    text += fmt::format("<li>and {} more, in clashes.csv</li>", clash.inside.size() - listed);
  return text + "</ul></details>";
}

std::string figureOf(const ViewScene& scene, const Clash& clash) {
  std::string text = fmt::format("<figure id=\"clash-{}\"><img src=\"{}\" alt=\"{}\" width=\"640\" height=\"480\" ",
                                 clash.number, pictureName(clash.number), escapeHtml(titleOf(scene, clash)));
  text += fmt::format("loading=\"lazy\"><figcaption>{}. {}", clash.number, namesOf(scene, clash));
  text += fmt::format("<br><span class=\"fact\">{}{}</span>", badgeOf(clash), escapeHtml(findingOf(scene, clash)));
  text += partsOf(scene, clash);
  return text + "</figcaption></figure>\n";
}

std::string numberCell(const std::string& text) { return fmt::format("<td class=\"number\">{}</td>", text); }

/// The cells behind the names: of shapes depth, distance and place, of boxes what they share.
std::string measuresOf(const Clash& clash) {
  std::string text;
  if (clash.exact != nullptr) {
    const ExactPair& pair = *clash.exact;
    const bool isKnown = pair.state != ExactState::NotExamined;
    text += numberCell(pair.depth ? shortNumber(*pair.depth) : "");
    text += numberCell(isKnown && !isContact(pair.state) ? shortNumber(pair.distance) : "");
    for (const std::string& coordinate : coordinatesOf(allpairs::placeOf(pair)))
      text += numberCell(isKnown ? coordinate : "");
    return text;
  }
  for (const double extent : clash.overlap) text += numberCell(shortNumber(extent));
  return text + numberCell(shortNumber(clash.volume));
}

std::string rowOf(const ViewScene& scene, const Clash& clash, bool hasPicture) {
  const std::string number =
      hasPicture ? fmt::format("<a href=\"#clash-{0}\">{0}</a>", clash.number) : std::to_string(clash.number);
  const std::string state = clash.exact == nullptr && !clash.isNew ? "" : "<td>" + badgeOf(clash) + "</td>";
  const std::string more = clash.inside.empty() ? "" : fmt::format(" (worst of {} pairs)", clash.inside.size() + 1);
  return fmt::format("<tr>{}{}<td>{}</td><td>{}{}</td>{}</tr>\n", numberCell(number), state,
                     escapeHtml(firstNameOf(scene, clash)),
                     clash.isSelf() ? "itself" : escapeHtml(secondNameOf(scene, clash)), more, measuresOf(clash));
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + '"';
}

/// A name as a cell that no spreadsheet takes for a formula: an apostrophe before it says that it is text.
std::string cellOf(const std::string& name) { return quoted(looksLikeFormula(name) ? "'" + name : name); }

std::string csvMeasuresOf(const Clash& clash) {
  if (clash.exact == nullptr)
    return fmt::format("{},{},{},{}", clash.overlap[0], clash.overlap[1], clash.overlap[2], clash.volume);
  const ExactPair& pair = *clash.exact;
  if (pair.state == ExactState::NotExamined) return fmt::format("{},,,,,,,,,", stateName(pair.state));
  const auto [x, y, z] = allpairs::placeOf(pair);
  return fmt::format("{},{},{},{},{},{},{},{},{},{}", stateName(pair.state),
                     pair.depth ? fmt::to_string(*pair.depth) : "", pair.distance, x, y, z, pair.normal[0],
                     pair.normal[1], pair.normal[2], pair.contactCount);
}

std::string idCellsOf(const ViewScene& scene, std::uint32_t model) {
  if (scene.ids.empty()) return {};
  return ',' + cellOf(scene.kinds[model]) + ',' + cellOf(scene.ids[model]);
}

/// A pair of a row.
void writeCsvLine(const ViewScene& scene, const Clash& row, const Clash& pair, scene::ByteSink sink) {
  const std::string since = row.isNew ? (*row.isNew ? ",new" : ",persisting") : "";
  sink(fmt::format("{},{},{},{}{}{}{},{}\n", row.number, cellOf(scene.name(pair.first)),
                   cellOf(scene.name(pair.second)), csvMeasuresOf(pair), idCellsOf(scene, pair.first),
                   idCellsOf(scene, pair.second), since, row.guid));
}

bool isAscii(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

std::string counted(std::size_t count, const char* noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

/// How bad it is: the first clash.
std::string worstOf(const ViewScene& scene, std::span<const Clash> clashes) {
  if (!scene.isExact || clashes.empty() || !isClash(clashes.front().exact->state)) return {};
  return fmt::format("<p class=\"worst\">The worst: {}. {}</p>\n", escapeHtml(titleOf(scene, clashes.front())),
                     escapeHtml(findingOf(scene, clashes.front())));
}

/// What was left out, and of what.
std::string scopeOf(const ViewScene& scene, std::size_t candidates) {
  std::string text = fmt::format("<p>{}, {} by their boxes. {}.", counted(scene.modelCount, "model"),
                                 counted(candidates, "candidate"), escapeHtml(scene.method));
  if (!scene.bodies.empty()) text += " Pairs of the same two bodies are one row: the worst of them.";
  if (scene.clearance > 0.0) text += fmt::format(" Clearance {}.", shortNumber(scene.clearance));
  const std::uint64_t apart = scene.isExact ? countStates(scene.exact).of(ExactState::Apart) : 0;
  if (apart != 0)
    text += fmt::format(" {} that {} apart by {} {} not shown.", counted(apart, "candidate"), apart == 1 ? "is" : "are",
                        apart == 1 ? "its shapes" : "their shapes", apart == 1 ? "is" : "are");
  if (!scene.ignored.empty())
    text += fmt::format(" {} of the input left out: 'allpairs info' lists {}.", counted(scene.ignored.size(), "part"),
                        scene.ignored.size() == 1 ? "it" : "them");
  return text + "</p>\n";
}

constexpr const char* kOfShapes =
    "<p>Shapes were tested. Duplicates come first, then contained parts, then clashes, the deepest first. Red is where "
    "surfaces cross, and a line with two ends is the depth, or the gap.</p>\n";
constexpr const char* kOfBoxes =
    "<p>A pair is two models whose axis-aligned bounding boxes are near enough: they may touch, and only a look at "
    "their shapes says whether they do. Red is what the two boxes share. The largest comes first; models that may "
    "touch themselves come last.</p>\n";

/// What has changed since the earlier report.
std::string changesOf(const Since* since) {
  if (since == nullptr) return {};
  std::string text = fmt::format("<p class=\"worst\">Since {}: {}.</p>\n", escapeHtml(since->name), countText(*since));
  if (since->resolved.empty()) return text;
  text += "<details><summary>Resolved</summary><ul>";
  for (const EarlierClash& clash : std::span(since->resolved).first(std::min(since->resolved.size(), kMostRows)))
    text += fmt::format("<li>{} and {}</li>", escapeHtml(clash.first), escapeHtml(clash.second));
  return text + "</ul></details>\n";
}

std::string introduction(const Report& report) {
  const auto& [scene, clashes, pictured, since] = report;
  const std::size_t candidates = scene.frames.front().pairs.size();
  const std::size_t count = clashes.size();
  std::string text =
      fmt::format("<h1>{}</h1>\n<p class=\"headline\">{}</p>\n", escapeHtml(scene.title), headlineOf(scene));
  text += changesOf(since) + worstOf(scene, clashes) + scopeOf(scene, candidates);
  if (candidates == 0) return text + "<p>No two models are near enough to touch: there is nothing to look at.</p>\n";
  if (count == 0) return text + "<p>No two models touch: there is nothing to look at.</p>\n";
  text += scene.isExact ? kOfShapes : kOfBoxes;
  text += "<p>Also in this folder: <a href=\"clashes.csv\">clashes.csv</a>, <a href=\"clashes.bcf\">clashes.bcf</a>.";
  if (pictured < count) text += fmt::format(" The first {} have pictures and are in the BCF file.", pictured);
  if (kMostRows < count) text += fmt::format(" The table here has the first {}, clashes.csv has all.", kMostRows);
  return text + "</p>\n";
}

void writeTable(const ViewScene& scene, std::span<const Clash> clashes, std::size_t pictured, scene::ByteSink sink) {
  if (clashes.empty()) return;
  sink("<div class=\"scroll\"><table>\n<thead><tr><th class=\"number\">#</th>");
  if (scene.isExact || clashes.front().isNew) sink("<th>state</th>");
  sink("<th>first</th><th>second</th>");
  if (scene.isExact) {
    sink("<th class=\"number\">depth</th><th class=\"number\">distance</th>");
    sink("<th class=\"number\">at x</th><th class=\"number\">y</th><th class=\"number\">z</th>");
  } else {
    sink("<th class=\"number\">overlap x</th><th class=\"number\">y</th><th class=\"number\">z</th>");
    sink("<th class=\"number\">shared volume</th>");
  }
  sink("</tr></thead>\n<tbody>\n");
  for (const Clash& clash : clashes) sink(rowOf(scene, clash, clash.number <= pictured));
  sink("</tbody>\n</table></div>\n");
}

}  // namespace

std::string pictureName(std::size_t number) { return fmt::format("pictures/{:04}.png", number); }

void writeReportPage(const Report& report, scene::ByteSink sink) {
  const auto& [scene, clashes, pictured, since] = report;
  sink("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n");
  sink("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n");
  sink("<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src 'self' file:; ");
  sink("style-src 'unsafe-inline'\">\n");
  sink(fmt::format("<title>{} – clashes</title>\n<style>{}</style>\n</head>\n<body>\n<main>\n", escapeHtml(scene.title),
                   kStyle));
  sink(introduction(report));
  sink("<section class=\"clashes\">\n");
  for (const Clash& clash : clashes.first(pictured)) sink(figureOf(scene, clash));
  sink("</section>\n");
  writeTable(scene, clashes.first(std::min(clashes.size(), kMostRows)), pictured, sink);
  sink("</main>\n</body>\n</html>\n");
}

void writeReportCsv(const Report& report, scene::ByteSink sink) {
  constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";  // without it some spreadsheets take another character set
  const ViewScene& scene = report.scene;
  if (!std::all_of(scene.names.begin(), scene.names.end(), isAscii)) sink(kUtf8Mark);
  sink(scene.isExact ? "number,first,second,state,depth,distance,x,y,z,normal_x,normal_y,normal_z,contacts"
                     : "number,first,second,overlap_x,overlap_y,overlap_z,volume");
  if (!scene.ids.empty()) sink(",first_type,first_id,second_type,second_id");
  sink(report.since == nullptr ? ",guid\n" : ",since,guid\n");
  for (const Clash& clash : report.clashes) {
    writeCsvLine(scene, clash, clash, sink);
    for (const Clash& pair : clash.inside) writeCsvLine(scene, clash, pair, sink);
  }
  if (report.since == nullptr) return;
  const std::size_t left = (scene.isExact ? 10U : 4U) + (scene.ids.empty() ? 0U : 4U);
  for (const EarlierClash& clash : report.since->resolved) {
    sink(fmt::format(",{},{},{}resolved,{}\n", cellOf(clash.first), cellOf(clash.second), std::string(left, ','),
                     clash.guid));
  }
}

}  // namespace allpairs::view
