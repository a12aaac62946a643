// SPDX-License-Identifier: MIT
// An analysis as one HTML file that needs nothing else: no network, no script, plots as SVG within. Readable in grey
// and on a narrow screen. Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "study/analysis/analysis.hpp"
#include "study/published/published.hpp"

namespace burin::study {

// Figures of a study beside its tables, such as its flow of participants or a sample trial.
struct ReportSection {
    std::string heading;
    std::vector<std::string> sentences;
    std::vector<std::string> figures;  // SVG
};

// What the report says of itself.
struct ReportOrigin {
    std::string data;                          // the file that was analysed
    std::string program;                       // with its version
    std::vector<std::string> facts = {};       // whole sentences about the study, shown first
    std::vector<ReportSection> sections = {};  // shown before the analysis
    std::string title = {};                    // of the study; empty: the file's name
};

[[nodiscard]] std::string html_report(const Analysis& analysis, const std::vector<PublishedComparison>& published,
                                      const ReportOrigin& origin);

}  // namespace burin::study
