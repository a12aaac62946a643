// SPDX-License-Identifier: MIT
#include "study/felt/trial_marks.hpp"

namespace burin::study {

std::vector<TrialMark> TrialMarks::take(const StageSession& session) {
    std::vector<TrialMark> marks;
    const std::vector<StageEvent>& events = session.events();
    for (; events_told_ < events.size(); ++events_told_) {
        const StageEvent& event = events[events_told_];
        const Nanoseconds at_ns = session.begun_ns() + nanoseconds(event.time_s);
        if (event.kind == StageEventKind::clock_started) {
            open_ = true;
            marks.push_back({at_ns, true, {}});
        }
        if (!open_ || event.kind == StageEventKind::clock_started || event.kind == StageEventKind::start_touched)
            continue;
        const char* state = event.kind == StageEventKind::end_touched      ? "done"
                            : event.kind == StageEventKind::attempt_failed ? name_of(event.failure)
                                                                           : name_of(session.state().result);
        open_ = false;
        marks.push_back({at_ns, false, state});
    }
    return marks;
}

}  // namespace burin::study
