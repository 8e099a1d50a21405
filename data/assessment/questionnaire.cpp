#include <fmt/format.h>

#include "data/assessment/html.h"
#include "data/assessment/page.h"
#include "data/formats/markup.h"

namespace ostium::data {

std::string questionnaire_page() {
  static const char* const face[] = {
      "The picture looks like one of the catheter laboratory.",
      "Wire and catheter move in the picture as they do in a patient.",
      "Turning the guide feels as it does in a patient, with its lag and its jump.",
      "The heart's beat, and how it moves instruments, is believable.",
      "Contrast fills, streams back and washes out as in life.",
      "The balloon opens the narrowing as in life.",
      "ECG and pressure answer when a vessel is closed.",
      "The order of work is that of the laboratory.",
  };
  static const char* const content[] = {
      "It trains engaging an ostium.",
      "It trains crossing a lesion with a wire.",
      "It trains holding two instruments still while a third one slides.",
      "It trains choosing sizes of balloons and stents.",
      "It trains placing a stent, with its margins.",
      "It trains spending little radiation and contrast.",
      "What it counts as an error is one.",
      "Somebody who has trained here would be safer in their first cases.",
  };
  const auto table = [](const char* id, const char* const* items, std::size_t count) {
    std::string out = fmt::format(
        "<table id=\"{}\"><tr><th>statement</th><th>1 (not at all) to 5 (fully)</th><th>remark</th></tr>\n", id);
    for (std::size_t i = 0; i < count; ++i) {
      out += "<tr><td>" + escaped(items[i]) + "</td><td>";
      for (int k = 1; k <= 5; ++k)
        out += fmt::format("<label><input type=\"radio\" name=\"{}{}\" value=\"{}\"> {}</label> ", id, i, k, k);
      out += "</td><td><input type=\"text\"></td></tr>\n";
    }
    return out + fmt::format("</table>\n<p><button onclick=\"save('{0}','{0}.csv')\">Save as CSV</button></p>\n", id);
  };
  return html_page(
      "Questionnaires",
      "<p>Participant code (no name): <input type=\"text\"> &nbsp; procedures done as first operator: <input "
      "type=\"text\"></p>\n<h2>Does it look and feel right? (face)</h2>\n" +
          table("face", face, std::size(face)) + "<h2>Does it train what is needed? (content)</h2>\n" +
          table("content", content, std::size(content)));
}

}  // namespace ostium::data
