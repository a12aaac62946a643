// SPDX-License-Identifier: MIT
// burin rehab NAME, burin rehab report: exercises of a hand in a glove (activities/rehab), with the therapist's
// settings of one file.
#pragma once

#include "app/cli/command_table.hpp"

namespace burin::app {

[[nodiscard]] CommandRow rehab_row();

}  // namespace burin::app
