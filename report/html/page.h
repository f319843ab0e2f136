// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace hexcal {

// All text here is plain: the page escapes it. UTF-8.

struct HtmlTable {
  struct Column {
    std::string heading;
    bool is_number = false;
  };
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> rows;
  int chosen_row = -1;  // set off from the others
};

struct TitledTable {
  std::string title;
  HtmlTable table;
};

// A picture for plotly.js with what one needs to read it. Strings in data and layout that come
// from a file go through EscapeLabel; "@before" and the like are colours of the present look
// (assets/page.js).
struct Chart {
  std::string title;
  std::string shows;  // what it shows, one sentence
  std::string good;   // what good looks like
  nlohmann::ordered_json data = nlohmann::ordered_json::array();
  nlohmann::ordered_json layout = nlohmann::ordered_json::object();
  HtmlTable table;  // the same numbers
  bool is_in_space = false;
  bool has_rows = false;  // each of which needs its height on paper, too
};

// A picture that needs no library: SVG elements in a box of width times height units, which are
// 1.35 pixels at most. What comes from a file in svg is escaped by who draws it;
// colours are the page's (currentColor, var(--link)).
struct Drawing {
  std::string title, shows, good;
  int width = 0, height = 0;
  std::string svg;
};

// How loud a box is.
enum class Tone { kGood, kWarn, kBad };

// One HTML file that opens offline: Content-Security-Policy by hashes, no request, readable without
// scripts, for light and dark screens and for paper. Where hexcal was built without the chart
// library, tables stand in place of the pictures.
class HtmlPage {
 public:
  // kind: what the report is of ("discover"); stands in the file's first line.
  HtmlPage(std::string kind, std::string title, std::string subtitle);

  void Section(std::string_view heading);
  void Heading(std::string_view text);  // within a section
  void Paragraph(std::string_view text);
  void Note(std::string_view text);  // a paragraph of lesser weight
  void List(const std::vector<std::string>& items);
  void Table(const HtmlTable& table);
  void Tables(const std::vector<TitledTable>& tables);  // side by side where there is room
  void Code(std::string_view text);
  // JSON for programs: <script type="application/json" id="...">, which shows nothing.
  void Data(std::string_view id, std::string_view json);
  // A sentence in a box under a word; `id` marks it for programs that read the page.
  void Verdict(Tone tone, std::string_view id, std::string_view word, std::string_view sentence);
  void Figure(const Chart& chart);
  void Figure(const Drawing& drawing);
  void Figures(const std::vector<Chart>& charts);  // side by side where there is room

  // At the foot of every printed page, with the page's number: letters, digits, spaces, . : -
  void Footer(std::string_view text);

  std::string Html() const;

  // What the second line of such a page is; and what it begins with, before the kind.
  static std::string Mark(std::string_view kind);
  static std::string AnyMark() { return "<!-- hexcal/report/"; }

 private:
  std::string kind_, title_, subtitle_;
  std::string body_, footer_;
  int charts_ = 0;
  bool has_flat_ = false, has_space_ = false;
};

}  // namespace hexcal
