// SPDX-License-Identifier: MIT
#include "base/plot/html.hpp"

#include "base/plot/svg.hpp"

namespace burin::plot {
namespace {

constexpr const char* kStyle = R"(<style>
body { font: 16px/1.45 "DejaVu Sans", Arial, sans-serif; max-width: 62em; margin: 1em auto; padding: 0 1em;
  color: #111; }
p { overflow-wrap: anywhere; }
h1 { font-size: 1.5em; } h2 { font-size: 1.2em; margin-top: 2em; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.85em; }
th, td { border: 1px solid #999; padding: 0.25em 0.6em; text-align: left; vertical-align: top; }
table.figures { min-width: 50em; }
td.number { text-align: right; white-space: nowrap; }
.warning { border-left: 0.4em solid #000; padding: 0.2em 0.8em; background: #eee; }
.plots { display: grid; grid-template-columns: 1fr 1fr; gap: 1em; align-items: start; }
.plots svg { width: 100%; height: auto; }
.plots svg:only-child { grid-column: 1 / -1; }
@media (max-width: 45em) { .plots { grid-template-columns: 1fr; } }
.wide svg { width: 100%; min-width: 40em; height: auto; display: block; }
pre { font-size: 0.8em; overflow-x: auto; background: #f4f4f4; padding: 0.8em; }
</style>
)";

}  // namespace

std::string page_begin(std::string_view title, std::string_view language, std::string_view style) {
    const std::string own = style.empty() ? "" : "<style>\n" + std::string(style) + "</style>\n";
    return "<!DOCTYPE html>\n<html lang=\"" + escaped(language) +
           "\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
           escaped(title) + "</title>\n" + kStyle + own + "</head>\n<body>\n";
}

std::string page_end() { return "</body>\n</html>\n"; }

std::string element(const char* name, std::string_view text) {
    return std::string("<") + name + ">" + escaped(text) + "</" + name + ">\n";
}

std::string cell(std::string_view text) { return "<td>" + escaped(text) + "</td>"; }

std::string number_cell(std::string_view text) { return "<td class=\"number\">" + escaped(text) + "</td>"; }

}  // namespace burin::plot
