// SPDX-License-Identifier: MIT
#include "app/session/end_signals.hpp"

namespace burin {
namespace {

volatile sig_atomic_t g_came = 0;  // a handler reaches nothing but the process's own

void note(int) { g_came = 1; }

}  // namespace

EndSignals::EndSignals() : before_{{{SIGINT, {}}, {SIGTERM, {}}}} {
    g_came = 0;
    for (Before& one : before_) {
        sigaction(one.signal, nullptr, &one.action);
        if (one.action.sa_handler == SIG_IGN) continue;
        struct sigaction ours{};
        ours.sa_handler = note;
        ours.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
        sigemptyset(&ours.sa_mask);
        sigaction(one.signal, &ours, nullptr);
    }
}

EndSignals::~EndSignals() {
    for (const Before& one : before_) sigaction(one.signal, &one.action, nullptr);
}

bool EndSignals::came() const { return g_came != 0; }

}  // namespace burin
