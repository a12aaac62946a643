// SPDX-License-Identifier: MIT
// The frame of a report as one HTML file that needs nothing else: no network, no script, plots as SVG within. Readable
// in grey and on a narrow screen. Texts are escaped. The same arguments give the same text.
#pragma once

#include <string>
#include <string_view>

namespace burin::plot {

// Begins a page with its style, up to its body; page_end() ends it. Classes: "wide" scrolls what is wider than the
// screen, "plots" puts figures side by side, "warning" marks a paragraph, "number" a cell.
// language: by its code; style: rules of CSS besides.
[[nodiscard]] std::string page_begin(std::string_view title, std::string_view language = "en",
                                     std::string_view style = {});
[[nodiscard]] std::string page_end();

[[nodiscard]] std::string element(const char* name, std::string_view text);
[[nodiscard]] std::string cell(std::string_view text);
[[nodiscard]] std::string number_cell(std::string_view text);

}  // namespace burin::plot
