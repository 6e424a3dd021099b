// SPDX-License-Identifier: MIT
#include "Report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "Bcf.h"
#include "PageTemplate.h"
#include "Text.h"
#include "allpairs/Error.h"

namespace allpairs::view {
namespace {

constexpr std::size_t kMostRows = 10'000;  // of more, browsers take seconds to lay out the page

/// The class and the GlobalId of a model that has them; of a row of several pairs, where they are the body's.
std::string kindOf(const ViewScene& scene, const Clash& clash, std::uint32_t model) {
  if (scene.ids.empty() || scene.ids[model].empty()) return {};
  if (!clash.inside.empty() && scene.bodyIdentities[scene.bodyOf(model)] != scene.ids[model]) return {};
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

/// The state as a word with a colour, and what has become of it.
std::string badgeOf(const Clash& clash) {
  std::string text;
  if (clash.since) text = fmt::format("<span class=\"state {0}\">{0}</span> ", changeName(*clash.since));
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

/// The picture, which opens the page at the pair: its address has the numbers of models, since names may repeat.
std::string pictureOf(const Report& report, const Clash& clash) {
  std::string picture = fmt::format("<img src=\"{}\" alt=\"{}\" width=\"640\" height=\"480\" loading=\"lazy\">",
                                    pictureName(clash.number), escapeHtml(titleOf(report.scene, clash)));
  if (!report.withoutPage.empty()) return picture;
  return fmt::format("<a href=\"view.html#pair=@{},@{}\" title=\"Open it in 3D\">{}</a>", clash.first, clash.second,
                     picture);
}

std::string figureOf(const Report& report, const Clash& clash) {
  const ViewScene& scene = report.scene;
  std::string text =
      fmt::format("<figure id=\"clash-{}\" data-guid=\"{}\" data-status=\"{}\">{}<figcaption>{}. {}", clash.number,
                  clash.guid, topicStatusOf(clash), pictureOf(report, clash), clash.number, namesOf(scene, clash));
  text += fmt::format("<br><span class=\"fact\">{}{}</span>", badgeOf(clash),
                      escapeHtml(findingOf(scene, clash) + beforeText(clash)));
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
  const std::string order =  // states are sorted by how bad they are
      clash.exact == nullptr ? "" : fmt::format(" data-order=\"{}\"", static_cast<int>(clash.exact->state));
  const std::string state =
      clash.exact == nullptr && !clash.since ? "" : fmt::format("<td{}>{}</td>", order, badgeOf(clash));
  const std::string more = clash.inside.empty() ? "" : fmt::format(" (worst of {} pairs)", clash.inside.size() + 1);
  return fmt::format("<tr data-guid=\"{}\">{}{}<td>{}</td><td>{}{}</td>{}</tr>\n", clash.guid, numberCell(number),
                     state, escapeHtml(firstNameOf(scene, clash)),
                     clash.isSelf() ? "itself" : escapeHtml(secondNameOf(scene, clash)), more, measuresOf(clash));
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
  std::string method = scene.method == "boxes" || scene.method == "shapes" ? "" : ' ' + escapeHtml(scene.method) + '.';
  if (method.starts_with(" shapes")) method[1] = 'S';
  std::string text = fmt::format("<p>{}, {} by their boxes.{}", counted(scene.modelCount, "model"),
                                 counted(candidates, "candidate"), method);
  if (!scene.bodies.empty()) text += " Pairs that belong together are one row: the worst of them.";
  if (scene.clearance > 0.0) text += fmt::format(" Clearance {}.", shortNumber(scene.clearance));
  const std::uint64_t apart = scene.isExact ? countStates(scene.exact).of(ExactState::Apart) : 0;
  if (apart != 0)
    text += fmt::format(" {} that {} apart by {} {} not shown.", counted(apart, "candidate"), apart == 1 ? "is" : "are",
                        apart == 1 ? "its shapes" : "their shapes", apart == 1 ? "is" : "are");
  return text + "</p>\n";
}

/// What of the input was not read, and so not tested.
std::string leftOutOf(const ViewScene& scene) {
  if (scene.ignored.empty()) return {};
  std::string text = fmt::format("<details><summary>{} of the input left out, and not tested</summary><ul>",
                                 counted(scene.ignored.size(), "part"));
  for (const scene::Remark& remark : std::span(scene.ignored).first(std::min(scene.ignored.size(), kMostRows)))
    text += fmt::format("<li>{}</li>", escapeHtml(validUtf8(textOf(remark))));
  if (scene.ignored.size() > kMostRows) text += fmt::format("<li>and {} more</li>", scene.ignored.size() - kMostRows);
  return text + "</ul></details>\n";
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
  if (since->gone.empty()) return text;
  text += "<details><summary>Resolved, and no longer listed</summary><ul>";
  for (const EarlierClash& clash : std::span(since->gone).first(std::min(since->gone.size(), kMostRows)))
    text += fmt::format("<li>{} and {}</li>", escapeHtml(clash.first), escapeHtml(clash.second));
  if (since->gone.size() > kMostRows)
    text += fmt::format("<li>and {} more, in clashes.csv</li>", since->gone.size() - kMostRows);
  return text + "</ul></details>\n";
}

/// When it was made, of what, how.
std::string aboutOf(const Report& report) {
  std::string text = "<dl class=\"about\">";
  for (const auto& [name, value] : report.facts)
    text += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", escapeHtml(name), escapeHtml(value));
  return report.facts.empty() ? "" : text + "</dl>\n";
}

/// What else is in the folder.
std::string filesOf(const Report& report) {
  std::string text = "<p>";
  if (report.withoutPage.empty())
    text += "<a href=\"view.html\">Open it in 3D</a>; a picture opens its pair. ";
  else
    text += fmt::format("Not in 3D: {}. ", escapeHtml(report.withoutPage));
  text += "Also in this folder: <a href=\"clashes.csv\">clashes.csv</a>, <a href=\"clashes.bcf\">clashes.bcf</a>.";
  const std::size_t count = report.clashes.size();
  if (report.pictured < count)
    text += fmt::format(" The first {} have pictures and are in the BCF file.", report.pictured);
  if (kMostRows < count) text += fmt::format(" The table here has the first {}, clashes.csv has all.", kMostRows);
  return text + "</p>\n";
}

std::string introduction(const Report& report) {
  const ViewScene& scene = report.scene;
  const std::span<const Clash> clashes = report.clashes;
  const std::size_t candidates = scene.frames.front().pairs.size();
  const std::size_t count = clashes.size();
  std::string text =
      fmt::format("<h1>{}</h1>\n<p class=\"headline\">{}</p>\n", escapeHtml(scene.title), headlineOf(scene));
  text += changesOf(report.since) + worstOf(scene, clashes) + scopeOf(scene, candidates) + leftOutOf(scene) +
          aboutOf(report);
  if (scene.modelCount == 0) return text + "<p>The input has no models.</p>\n";
  if (candidates == 0) return text + "<p>No pair was found: there is nothing to look at.</p>\n";
  if (count == 0) return text + "<p>No two models touch: there is nothing to look at.</p>\n";
  return text + (scene.isExact ? kOfShapes : kOfBoxes) + filesOf(report);
}

void writeTable(const ViewScene& scene, std::span<const Clash> clashes, std::size_t pictured, scene::ByteSink sink) {
  if (clashes.empty()) return;
  sink("<div class=\"scroll\"><table>\n<thead><tr><th class=\"number\">#</th>");
  if (scene.isExact || clashes.front().since) sink("<th>state</th>");
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

std::string unitText(double metres) {
  constexpr std::array<std::pair<double, const char*>, 7> kWords{{{1.0, "metres"},
                                                                  {1e-3, "millimetres"},
                                                                  {1e-2, "centimetres"},
                                                                  {1e3, "kilometres"},
                                                                  {0.0254, "inches"},
                                                                  {0.3048, "feet"},
                                                                  {0.9144, "yards"}}};
  constexpr double kRounding = 1e-6;  // a float32 that was converted
  for (const auto& [length, word] : kWords) {
    if (std::abs(metres - length) <= kRounding * length) return word;
  }
  return fmt::format("units of {} m", shortNumber(metres));
}

void writeReportPage(const Report& report, scene::ByteSink sink) {
  constexpr std::string_view kTitle = "<!--ALLPAIRS-TITLE-->";
  constexpr std::string_view kPlace = "<!--ALLPAIRS-REPORT-->";
  const std::string_view page = reportTemplate();
  const std::size_t title = page.find(kTitle);
  const std::size_t place = page.find(kPlace);
  if (place == std::string_view::npos || title > place) throw Error("the page of reports has no place for a report");
  const std::span<const Clash> clashes = report.clashes;
  sink(page.substr(0, title));
  sink(fmt::format("{} – clashes", escapeHtml(report.scene.title)));
  sink(page.substr(title + kTitle.size(), place - title - kTitle.size()));
  sink(introduction(report));
  sink("<section class=\"clashes\">\n");
  for (const Clash& clash : clashes.first(report.pictured)) sink(figureOf(report, clash));
  sink("</section>\n");
  writeTable(report.scene, clashes.first(std::min(clashes.size(), kMostRows)), report.pictured, sink);
  sink(page.substr(place + kPlace.size()));
}

}  // namespace allpairs::view
