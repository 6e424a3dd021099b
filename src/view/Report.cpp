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
p{color:var(--soft);max-width:60rem}.clashes{display:grid;gap:1rem;
grid-template-columns:repeat(auto-fill,minmax(min(20rem,100%),1fr))}
figure{margin:0;background:var(--paper);border:1px solid var(--line);border-radius:.5rem;overflow:hidden}
figure img{display:block;width:100%;height:auto;aspect-ratio:4/3}figcaption{padding:.6rem .9rem;overflow-wrap:anywhere}
.first,.second{font-weight:600}.first::before,.second::before{content:"";display:inline-block;width:.7em;height:.7em;
border-radius:50%;margin-right:.4em;background:#0072b2}.second::before{background:#e69f00}
.fact{color:var(--soft);font-variant-numeric:tabular-nums}.scroll{overflow-x:auto}
table{border-collapse:collapse;background:var(--paper);margin-top:1rem;min-width:100%}
th,td{text-align:left;padding:.3rem .8rem;border-bottom:1px solid var(--line);overflow-wrap:anywhere}
td.number,th.number{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
@media print{figure{break-inside:avoid}}
)";

constexpr std::size_t kMostRows = 10'000;  // of more, browsers take seconds to lay out the page

std::string namesOf(const ViewScene& scene, const Clash& clash) {
  std::string text = fmt::format("<span class=\"first\">{}</span>", escapeHtml(scene.name(clash.first)));
  if (clash.isSelf()) return text + " with itself";
  return text + fmt::format("<br><span class=\"second\">{}</span>", escapeHtml(scene.name(clash.second)));
}

/// Four digits, and no exponent before a number has ten.
std::string shortNumber(double value) {
  return std::abs(value) >= 1000.0 && std::abs(value) < 1e9 ? fmt::format("{:.0f}", value)
                                                            : fmt::format("{:.4g}", value);
}

std::string figureOf(const ViewScene& scene, const Clash& clash) {
  std::string text = fmt::format("<figure id=\"clash-{}\"><img src=\"{}\" alt=\"{}\" width=\"640\" height=\"480\" ",
                                 clash.number, pictureName(clash.number), escapeHtml(titleOf(scene, clash)));
  text += fmt::format("loading=\"lazy\"><figcaption>{}. {}", clash.number, namesOf(scene, clash));
  if (!clash.isSelf()) {
    text +=
        fmt::format("<br><span class=\"fact\">overlap {} × {} × {}, volume {}</span>", shortNumber(clash.overlap[0]),
                    shortNumber(clash.overlap[1]), shortNumber(clash.overlap[2]), shortNumber(clash.volume));
  }
  return text + "</figcaption></figure>\n";
}

std::string rowOf(const ViewScene& scene, const Clash& clash, bool hasPicture) {
  const std::string number =
      hasPicture ? fmt::format("<a href=\"#clash-{0}\">{0}</a>", clash.number) : std::to_string(clash.number);
  std::string text =
      fmt::format("<tr><td class=\"number\">{}</td><td>{}</td><td>{}</td>", number, escapeHtml(scene.name(clash.first)),
                  clash.isSelf() ? "itself" : escapeHtml(scene.name(clash.second)));
  for (const double extent : clash.overlap) text += fmt::format("<td class=\"number\">{}</td>", shortNumber(extent));
  return text + fmt::format("<td class=\"number\">{}</td></tr>\n", shortNumber(clash.volume));
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + '"';
}

/// A name as a cell that no spreadsheet takes for a formula: an apostrophe before it says that it is text.
std::string cellOf(const std::string& name) {
  constexpr std::string_view kFormulaBegins = "=+-@\t\r";
  const bool isLikeFormula = !name.empty() && kFormulaBegins.find(name.front()) != std::string_view::npos;
  return quoted(isLikeFormula ? "'" + name : name);
}

bool isAscii(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

std::string introduction(const ViewScene& scene, std::size_t count, std::size_t pictured) {
  std::string text = fmt::format("<h1>{}</h1>\n<p>{} models, {} pairs. {}.</p>\n", escapeHtml(scene.title),
                                 scene.modelCount, count, escapeHtml(scene.method));
  if (count == 0) return text + "<p>No two models are near enough to touch: there is nothing to look at.</p>\n";
  text +=
      "<p>A pair is two models whose axis-aligned bounding boxes are near enough: they may touch, and only a look at "
      "their shapes says whether they do. Red is what the two boxes share. The largest comes first; models that may "
      "touch themselves come last.</p>\n";
  text += "<p>Also in this folder: <a href=\"clashes.csv\">clashes.csv</a>, <a href=\"clashes.bcf\">clashes.bcf</a>.";
  if (pictured < count) text += fmt::format(" The first {} have pictures and are in the BCF file.", pictured);
  if (kMostRows < count) text += fmt::format(" The table here has the first {}, clashes.csv has all.", kMostRows);
  return text + "</p>\n";
}

void writeTable(const ViewScene& scene, std::span<const Clash> clashes, std::size_t pictured, scene::ByteSink sink) {
  if (clashes.empty()) return;
  sink("<div class=\"scroll\"><table>\n<thead><tr><th class=\"number\">#</th><th>first</th><th>second</th>");
  sink("<th class=\"number\">overlap x</th><th class=\"number\">y</th><th class=\"number\">z</th>");
  sink("<th class=\"number\">shared volume</th></tr></thead>\n<tbody>\n");
  for (const Clash& clash : clashes) sink(rowOf(scene, clash, clash.number <= pictured));
  sink("</tbody>\n</table></div>\n");
}

}  // namespace

std::string pictureName(std::size_t number) { return fmt::format("pictures/{:04}.png", number); }

void writeReportPage(const ViewScene& scene, std::span<const Clash> clashes, std::size_t pictured,
                     scene::ByteSink sink) {
  sink("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n");
  sink("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n");
  sink("<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src 'self' file:; ");
  sink("style-src 'unsafe-inline'\">\n");
  sink(fmt::format("<title>{} – clashes</title>\n<style>{}</style>\n</head>\n<body>\n<main>\n", escapeHtml(scene.title),
                   kStyle));
  sink(introduction(scene, clashes.size(), pictured));
  sink("<section class=\"clashes\">\n");
  for (const Clash& clash : clashes.first(pictured)) sink(figureOf(scene, clash));
  sink("</section>\n");
  writeTable(scene, clashes.first(std::min(clashes.size(), kMostRows)), pictured, sink);
  sink("</main>\n</body>\n</html>\n");
}

void writeReportCsv(const ViewScene& scene, std::span<const Clash> clashes, scene::ByteSink sink) {
  constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";  // without it some spreadsheets take another character set
  if (!std::all_of(scene.names.begin(), scene.names.end(), isAscii)) sink(kUtf8Mark);
  sink("number,first,second,overlap_x,overlap_y,overlap_z,volume,guid\n");
  for (const Clash& clash : clashes) {
    sink(fmt::format("{},{},{},{},{},{},{},{}\n", clash.number, cellOf(scene.name(clash.first)),
                     cellOf(scene.name(clash.second)), clash.overlap[0], clash.overlap[1], clash.overlap[2],
                     clash.volume, clash.guid));
  }
}

}  // namespace allpairs::view
