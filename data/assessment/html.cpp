#include "data/assessment/html.h"

#include <fmt/format.h>

#include "data/formats/markup.h"

namespace ostium::data {

namespace {

const char* const style = R"(
body { font: 15px/1.45 system-ui, sans-serif; color: #222; max-width: 1080px; margin: 24px auto; padding: 0 16px; }
h1 { font-size: 22px; margin: 0 0 4px; } h2 { font-size: 17px; margin: 30px 0 8px; }
.small, .note { color: #666; font-size: 13px; }
.note { border: 1px solid #ddd; padding: 6px 12px; background: #fafafa; }
table { border-collapse: collapse; font-size: 14px; } th { text-align: left; font-weight: 600; vertical-align: bottom; }
th, td { padding: 3px 14px 3px 0; border-bottom: 1px solid #e8e8e8; vertical-align: top; }
td.n { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
.yes { color: #00724f; } .no { color: #c0392b; font-weight: 600; } .open { color: #999; }
svg { max-width: 100%; height: auto; margin: 4px 6px 4px 0; }
figure { display: inline-block; margin: 0 8px 10px 0; width: 250px; vertical-align: top; } figure img { width: 250px; }
figcaption { font-size: 12px; color: #555; }
figure.plot { width: 525px; } figure.plot figcaption { font-size: 14px; font-weight: 600; color: #222; }
)";

const char* const save_script = R"(<script>
function save(id, name) {
  const rows = [...document.querySelectorAll('#' + id + ' tr')].map(row => [...row.cells].map(cell => {
    const box = cell.querySelector('input[type=checkbox]'), pick = cell.querySelector('input[type=radio]:checked'),
          text = cell.querySelector('textarea, input[type=text]');
    const value = box ? (box.checked ? '1' : '0') : pick ? pick.value : text ? text.value :
                  cell.querySelector('input') ? '' : cell.innerText;
    const safe = /^[=+\-@\t\r]/.test(value) && isNaN(value) ? "'" + value : value;
    return '"' + safe.replace(/"/g, '""').replace(/\n/g, ' ') + '"';
  }).join(','));
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([rows.join('\n') + '\n'], { type: 'text/csv' }));
  link.download = name;
  link.click();
}
</script>
)";

}  // namespace

std::string html_page(const std::string& title, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
         "content=\"width=device-width\">\n<title>" +
         escaped(title) + "</title><style>" + style + "</style>" + save_script + "</head><body>\n<h1>" +
         escaped(title) + "</h1>\n<p class=\"note\">Training and research, not for decisions on a patient.</p>\n" +
         body + "</body></html>\n";
}

std::string time_text(double s) {
  const int minutes = static_cast<int>(s) / 60;
  return fmt::format("{}:{:04.1f}", minutes, s - 60 * minutes);
}

}  // namespace ostium::data
