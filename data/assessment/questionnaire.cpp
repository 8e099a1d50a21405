#include <fmt/format.h>

#include "data/assessment/html.h"
#include "data/assessment/page.h"
#include "data/formats/markup.h"

namespace ostium::data {

namespace {

/// All tables as one file that `ostium study` reads, the participant's code in every row.
const char* const save_answers = R"(<script>
function saveAnswers() {
  const code = document.getElementById('code').value.trim(), said = document.getElementById('said');
  if (!code) { said.textContent = 'Please enter the participant code first.'; return; }
  const rows = [['code', 'part', 'statement', 'answer', 'remark']];
  for (const table of document.querySelectorAll('table.answers'))
    for (const row of table.rows) {
      if (row.querySelector('th')) continue;
      const [statement, answer, remark] = row.cells, pick = answer.querySelector('input[type=radio]:checked'),
            typed = answer.querySelector('input[type=text]'), text = remark.querySelector('input');
      rows.push([code, table.dataset.part, statement.innerText, pick ? pick.value : typed ? typed.value : '',
                 text ? text.value : '']);
    }
  const field = value => '"' + (/^[=+\-@\t\r]/.test(value) && isNaN(value) ? "'" + value : value)
      .replace(/"/g, '""').replace(/\s+/g, ' ').trim() + '"';
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([rows.map(row => row.map(field).join(',')).join('\n') + '\n'], { type: 'text/csv' }));
  link.download = 'answers-' + code.replace(/[^A-Za-z0-9_-]/g, '_') + '.csv';
  link.click();
  said.textContent = 'Saved: ' + link.download;
}
</script>
)";

}  // namespace

std::string questionnaire_page() {
  static const char* const about[] = {
      "Procedures done as first operator",
      "Years in the catheter laboratory",
      "Speciality",
      "Simulators used before",
      "Hand that leads",
  };
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
  const auto table = [](const char* part, const char* const* items, std::size_t count) {
    std::string out = fmt::format(
        "<table class=\"answers\" data-part=\"{}\"><tr><th>statement</th><th>1 (not at all) to 5 (fully)</th>"
        "<th>remark</th></tr>\n",
        part);
    for (std::size_t i = 0; i < count; ++i) {
      out += "<tr><td>" + escaped(items[i]) + "</td><td>";
      for (int k = 1; k <= 5; ++k)
        out += fmt::format("<label><input type=\"radio\" name=\"{}{}\" value=\"{}\"> {}</label> ", part, i, k, k);
      out += "</td><td><input type=\"text\" aria-label=\"remark\"></td></tr>\n";
    }
    return out + "</table>\n";
  };
  std::string asked;
  for (const char* what : about)
    asked +=
        fmt::format("<tr><td>{0}</td><td><input type=\"text\" aria-label=\"{0}\"></td><td></td></tr>\n", escaped(what));
  return html_page(
      "Questionnaires",
      "<p><label>Participant code (no name): <input type=\"text\" id=\"code\"></label></p>\n"
      "<h2>About you</h2>\n<table class=\"answers\" data-part=\"about\">" +
          asked + "</table>\n<h2>Does it look and feel right? (face)</h2>\n" + table("face", face, std::size(face)) +
          "<h2>Does it train what is needed? (content)</h2>\n" + table("content", content, std::size(content)) +
          "<p><button onclick=\"saveAnswers()\">Save as CSV</button> <span id=\"said\" role=\"status\"></span></p>\n" +
          save_answers);
}

}  // namespace ostium::data
