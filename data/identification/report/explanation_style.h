#pragma once
/// How pages of explanations look.

namespace ostium::data {

inline constexpr const char* explanation_style = R"(
body { font: 15px/1.45 system-ui, sans-serif; color: #222; max-width: 980px; margin: 24px auto; padding: 0 16px; }
h1 { font-size: 22px; margin: 0 0 4px; } h2 { font-size: 17px; margin: 28px 0 8px; }
.source { color: #666; font-size: 13px; }
.verdict { border-left: 6px solid #888; padding: 8px 14px; background: #f6f6f6; margin: 14px 0; font-size: 17px; }
.verdict.explained { border-color: #009e73; } .verdict.effect, .verdict.mostly { border-color: #0072b2; }
.verdict.unexplained { border-color: #d55e00; } .verdict.ambiguous { border-color: #cc79a7; }
.verdict.cannot_be_judged { border-color: #cc79a7; }
table { border-collapse: collapse; font-size: 14px; } th { text-align: left; font-weight: 600; }
th { vertical-align: bottom; } th, td { padding: 3px 14px 3px 0; border-bottom: 1px solid #e4e4e4; } td.n { text-align: right; font-variant-numeric: tabular-nums; }
tr.weak td { color: #888; } svg { max-width: 100%; height: auto; margin: 4px 6px 4px 0; }
)";

}  // namespace ostium::data
