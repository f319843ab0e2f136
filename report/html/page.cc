// SPDX-License-Identifier: BSD-3-Clause
#include "report/html/page.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <cctype>
#include <cstring>

#include "report/html/assets.h"
#include "report/html/escape.h"

namespace hexcal {
namespace {

constexpr int kPlotHeight = 450;  // px, where the layout states none: the chart library's own

bool HasCharts() { return !FlatCharts().empty() && !SpaceCharts().empty(); }

std::string TableHtml(const HtmlTable& table) {
  const auto cell = [&](const char* tag, std::size_t column, std::string_view text) {
    const bool is_number = table.columns[column].is_number;
    return fmt::format(
        "<{0}{1}>{2}</{0}>", tag, is_number ? " class=\"number\"" : "", EscapeHtml(text));
  };
  std::string html = "<div class=\"scroll\"><table>\n<thead><tr>";
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    html += cell("th", c, table.columns[c].heading);
  html += "</tr></thead>\n<tbody>\n";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    html += static_cast<int>(r) == table.chosen_row ? "<tr class=\"chosen\">" : "<tr>";
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      html += cell("td", c, table.rows[r].at(c));
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

// What one can do with a mouse alone is not for paper: " (hover for ...)", " (a click ...)".
std::string ForScreenAlone(std::string html) {
  for (const std::string_view start : {" (hover for ", " (a click "}) {
    const std::size_t at = html.find(start);
    const std::size_t end = at == std::string::npos ? at : html.find(')', at);
    if (end == std::string::npos) continue;
    html.insert(end + 1, "</span>");
    html.insert(at, "<span class=\"screen\">");
  }
  return html;
}

std::string Caption(std::string_view shows, std::string_view good) {
  return fmt::format("<figcaption><b>Shows</b> {} <b>Good looks like</b> {}</figcaption>\n",
                     ForScreenAlone(EscapeHtml(shows)),
                     EscapeHtml(good));
}

std::string_view ClassOf(Tone tone) {
  return tone == Tone::kGood ? "good" : tone == Tone::kWarn ? "warn" : "bad";
}

std::string Style(std::string_view text) { return fmt::format("<style>{}</style>\n", text); }
std::string Script(std::string_view text) { return fmt::format("<script>{}</script>\n", text); }

// A script that assets/page.js runs when a picture needs it.
std::string LaterScript(std::string_view id, std::string_view text) {
  return fmt::format("<script type=\"text/plain\" id=\"{}\">{}</script>\n", id, text);
}

}  // namespace

HtmlPage::HtmlPage(std::string kind, std::string title, std::string subtitle)
    : kind_(std::move(kind)), title_(std::move(title)), subtitle_(std::move(subtitle)) {}

std::string HtmlPage::Mark(std::string_view kind) {
  return fmt::format("{}{}/1 -->", AnyMark(), kind);
}

void HtmlPage::Section(std::string_view heading) {
  body_ += fmt::format("<h2>{}</h2>\n", EscapeHtml(heading));
}

void HtmlPage::Heading(std::string_view text) {
  body_ += fmt::format("<h3>{}</h3>\n", EscapeHtml(text));
}

void HtmlPage::Paragraph(std::string_view text) {
  body_ += fmt::format("<p>{}</p>\n", EscapeHtml(text));
}

void HtmlPage::Note(std::string_view text) {
  body_ += fmt::format("<p class=\"note\">{}</p>\n", EscapeHtml(text));
}

void HtmlPage::List(const std::vector<std::string>& items) {
  if (items.empty()) return;
  body_ += "<ul>\n";
  for (const std::string& item : items) body_ += fmt::format("<li>{}</li>\n", EscapeHtml(item));
  body_ += "</ul>\n";
}

void HtmlPage::Table(const HtmlTable& table) { body_ += TableHtml(table); }

void HtmlPage::Tables(const std::vector<TitledTable>& tables) {
  body_ += "<div class=\"tables\">\n";
  for (const TitledTable& titled : tables) {
    body_ += "<div>";
    Heading(titled.title);
    Table(titled.table);
    body_ += "</div>\n";
  }
  body_ += "</div>\n";
}

void HtmlPage::Code(std::string_view text) {
  body_ += fmt::format("<pre>{}</pre>\n", EscapeHtml(text));
}

void HtmlPage::Data(std::string_view id, std::string_view json) {
  body_ += fmt::format("<script type=\"application/json\" id=\"{}\">{}</script>\n",
                       EscapeHtml(id),
                       JsonTextForScript(json));
}

void HtmlPage::Verdict(Tone tone,
                       std::string_view id,
                       std::string_view word,
                       std::string_view sentence) {
  body_ +=
      fmt::format("<p class=\"verdict {}\" id=\"{}\"><strong>{}</strong> <span>{}</span></p>\n",
                  ClassOf(tone),
                  EscapeHtml(id),
                  EscapeHtml(word),
                  EscapeHtml(sentence));
}

void HtmlPage::Figure(const Chart& chart) {
  const std::string caption = Caption(chart.shows, chart.good);
  body_ += fmt::format("<figure>\n<h3>{}</h3>\n", EscapeHtml(chart.title));
  if (HasCharts()) {
    const int number = ++charts_;
    (chart.is_in_space ? has_space_ : has_flat_) = true;
    body_ += fmt::format(
        "<div class=\"plot\" role=\"img\" aria-label=\"{}\" data-spec=\"spec-{}\" "
        "data-library=\"{}\" data-height=\"{}\"{}></div>\n",
        EscapeHtml(chart.title),
        number,
        chart.is_in_space ? "3d" : "2d",
        chart.layout.value("height", kPlotHeight),
        chart.has_rows ? " data-rows=\"\"" : "");
    body_ += fmt::format("<script type=\"application/json\" id=\"spec-{}\">{}</script>\n",
                         number,
                         JsonForScript({{"data", chart.data}, {"layout", chart.layout}}));
    body_ += caption;
    if (!chart.table.columns.empty())
      body_ +=
          "<details><summary>The numbers</summary>\n" + TableHtml(chart.table) + "</details>\n";
  } else {
    body_ += caption;
    if (!chart.table.columns.empty()) body_ += TableHtml(chart.table);
  }
  body_ += "</figure>\n";
}

void HtmlPage::Figure(const Drawing& drawing) {
  constexpr double kLargestScale = 1.35;
  body_ += fmt::format(
      "<figure>\n<h3>{0}</h3>\n<svg class=\"drawing\" role=\"img\" aria-label=\"{0}\" "
      "viewBox=\"0 0 {1} {2}\" style=\"width:100%;max-width:{3:.0f}px\" fill=\"currentColor\" "
      "font-size=\"12.5\">\n{4}</svg>\n{5}</figure>\n",
      EscapeHtml(drawing.title),
      drawing.width,
      drawing.height,
      kLargestScale * drawing.width,
      drawing.svg,
      Caption(drawing.shows, drawing.good));
}

void HtmlPage::Figures(const std::vector<Chart>& charts) {
  body_ += "<div class=\"figures\">\n";
  for (const Chart& chart : charts) Figure(chart);
  body_ += "</div>\n";
}

void HtmlPage::Footer(std::string_view text) {
  for (const char c : text)
    CHECK(std::isalnum(static_cast<unsigned char>(c)) || std::strchr(" .:-", c) != nullptr) << text;
  footer_ = fmt::format(
      "@page {{ @bottom-left {{ content: \"{}\"; font: 7.5pt sans-serif; color: #444444; }}\n"
      "@bottom-right {{ content: counter(page) \" / \" counter(pages); font: 7.5pt sans-serif; "
      "color: #444444; }} }}\n",
      text);
}

std::string HtmlPage::Html() const {
  std::vector<std::string_view> scripts;
  if (has_flat_) scripts.push_back(FlatCharts());
  if (has_space_) scripts.push_back(SpaceCharts());
  if (!scripts.empty()) scripts.push_back(PageScript());
  std::string script_hashes = scripts.empty() ? " 'none'" : "";
  for (const std::string_view script : scripts) script_hashes += " " + PolicyHash(script);
  // The chart library adds an empty style element and fills it by rules, and sets style attributes.
  const std::string policy = fmt::format(
      "default-src 'none'; script-src{}; style-src-elem {} {}{}; style-src-attr 'unsafe-inline'; "
      "img-src data: blob:; base-uri 'none'; form-action 'none'",
      script_hashes,
      PolicyHash(PageCss()),
      PolicyHash(""),
      footer_.empty() ? "" : " " + PolicyHash(footer_));
  std::string html = fmt::format(
      "<!doctype html>\n{}\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"referrer\" content=\"no-referrer\">\n<title>{}</title>\n",
      Mark(kind_),
      EscapeHtml(policy),
      EscapeHtml(title_));
  html += Style(PageCss());
  if (!footer_.empty()) html += Style(footer_);
  html += "</head>\n<body>\n";
  html += fmt::format(
      "<h1>{}</h1>\n<p class=\"subtitle\">{}</p>\n", EscapeHtml(title_), EscapeHtml(subtitle_));
  if (!HasCharts())
    html +=
        "<p class=\"note\">This hexcal was built without its chart library (plotly.js): the tables "
        "stand in place of the pictures.</p>\n";
  else if (!scripts.empty())
    html +=
        "<noscript><p class=\"note\">Scripts are off: no picture is drawn. What each would show is "
        "in "
        "the table below or above it.</p></noscript>\n";
  if (body_.find("<details>") != std::string::npos)
    html +=
        "<p class=\"note paper\">Printed without the tables of numbers below the pictures: those "
        "that are opened on the screen are printed too, and the JSON files beside this page have "
        "them all.</p>\n";
  html += body_;
  if (has_flat_) html += LaterScript("library-2d", FlatCharts());
  if (has_space_) html += LaterScript("library-3d", SpaceCharts());
  if (!scripts.empty()) html += Script(PageScript());
  return html + "</body>\n</html>\n";
}

}  // namespace hexcal
