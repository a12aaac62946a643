// SPDX-License-Identifier: MIT
// A library with the functions of liblsl that Burin calls, written from lsl_c.h and lsl/*.h alone, and what a test sees
// and changes of it. It sends nothing: what is pushed stays in memory, and what is pulled a test has put there. It is
// as strict as the header's text, and more: a wrong format, a number of values that is no multiple of the channels, a
// handle that is none or was destroyed, a stamp that means something else, and two threads in one outlet are refused
// and noted.
//
// For a program that a test starts: BURIN_LSL_STAND_IN_XDF names a file that it writes as XDF when the last outlet is
// destroyed (github.com/sccn/xdf/wiki/Specifications), and BURIN_LSL_STAND_IN_MARKER is the text of a marker of a
// stream "Keyboard", which comes when an inlet asks. With BURIN_LSL_STAND_IN_BLOCKS no push returns.
// Each copy of the library has a state of its own. Its mutex guards all of it.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace burin::test {

struct LslNode {
    std::string name, text;
    std::vector<std::unique_ptr<LslNode>> children;

    // Returns the first child of that name; null: there is none.
    [[nodiscard]] const LslNode* child(const std::string& named) const {
        for (const auto& one : children)
            if (one->name == named) return one.get();
        return nullptr;
    }
    [[nodiscard]] std::string text_of(const std::string& named) const {
        const LslNode* const one = child(named);
        return one != nullptr ? one->text : "";
    }
};

// A stream that an outlet gives or that an inlet is to hear.
struct LslStream {
    std::string name, type, source_id, uid;
    std::int32_t channels = 0, format = 0;
    double rate_Hz = 0.0;
    std::shared_ptr<LslNode> description = std::make_shared<LslNode>();
    // What was pushed: stamps, values one sample after the other, or texts.
    std::vector<double> stamps_s;
    std::vector<float> values;
    std::vector<std::string> texts;
    std::size_t pushes = 0;
    bool is_open = false;
    // Of one that is heard.
    std::deque<std::pair<double, std::vector<std::string>>> waiting;
    double correction_s = 0.0;
    bool has_correction = true, is_lost = false;
    int inlets = 0;
};

struct LslStandIn {
    std::mutex mutex;
    std::condition_variable changed;
    std::vector<std::shared_ptr<LslStream>> outlets;  // all that were made
    std::vector<std::shared_ptr<LslStream>> remotes;
    std::string predicate;                // that was asked for last
    std::vector<std::string> violations;  // of the header's rules
    std::string error;                    // lsl_last_error()
    int strings = 0;                      // given and not destroyed
    // What a test changes.
    double clock_offset_s = 0.0;
    bool refuses_outlets = false, refuses_pushes = false, blocks_pushes = false;
    int blocked = 0;  // pushes that wait now
};

// Exported by the library as burin_lsl_stand_in.
using LslStandInOf = LslStandIn*();

}  // namespace burin::test
