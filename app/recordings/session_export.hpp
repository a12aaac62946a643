// SPDX-License-Identifier: MIT
// burin convert FILE.session [OUT] --to csv|npy|hdf5|mat|bids|log [--columns LIST] [--part NAME]: the ticks of one
// hand, or a derived table, for other programs. One thread.
#pragma once

#include <string>

#include "base/error.hpp"

namespace burin::app {

struct SessionExport {
    std::string in, out;                         // a session file; empty: IN with another ending
    std::string to;                              // the format of the table
    std::string columns, part, trials;           // of it
    std::string subject = "01", task = "touch";  // labels of a BIDS data set
};

// OUT must be new. Damaged blocks are left out and named; then it fails, with the rest written.
[[nodiscard]] Result<void> export_session(const SessionExport& options);

}  // namespace burin::app
