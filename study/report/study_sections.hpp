// SPDX-License-Identifier: MIT
// What a study's folder adds to the report of its trials: flow of participants, deviations from the protocol, and a
// sample trial of each group, replayed from its recorded motion.
#pragma once

#include <vector>

#include "study/folder/study_folder.hpp"
#include "study/report/html_report.hpp"

namespace burin::study {

[[nodiscard]] std::vector<ReportSection> report_sections(const StudyFolder& study);

}  // namespace burin::study
