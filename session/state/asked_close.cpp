// SPDX-License-Identifier: MIT
#include "session/state/asked_close.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include "session/state/session_orders.hpp"
#include "session/state/session_state.hpp"

namespace burin::session {
namespace {

constexpr std::array<std::string_view, 4> kDocumentIs{"saved", "changed", "saving", "failed"};
constexpr std::array<std::string_view, 4> kNameIs{"given", "free", "taken", "replaced"};

// What a hand has done is known this long after it at the latest: a steered hand comes after the cursor, the surface
// after the hand.
constexpr double kKnownAfter_s = 1.0;

bool is_unsaved(const SessionState& state) {
    const AskedClose& asked = state.asked;
    return asked.told && (asked.told->is != DocumentIs::saved || asked.rests_s < kKnownAfter_s);
}

}  // namespace

std::span<const std::string_view> document_states() { return kDocumentIs; }
std::span<const std::string_view> name_states() { return kNameIs; }

std::string short_name(const DocumentTold& told) { return std::filesystem::path(told.name).filename().string(); }

std::string state_text(const DocumentTold& told) {
    switch (told.is) {
        case DocumentIs::saved: return told.has_file ? "saved" : "new";
        case DocumentIs::saving: return "saving\u2026";
        case DocumentIs::changed:
        case DocumentIs::failed: return "changed";
    }
    return {};
}

std::string kept_text(const DocumentTold& told, const std::string& step) {
    if (told.is == DocumentIs::saved) return told.has_file ? "all of it is saved" : "nothing is changed yet";
    if (!told.keeps) return "kept: nothing until it is saved";
    if (told.strokes == 0) return "kept: all of it";
    if (told.kept < told.strokes)
        return "kept: up to " + step + " " + std::to_string(told.kept) + " of " + std::to_string(told.strokes);
    return told.strokes == 1 ? "kept: the one " + step : "kept: all " + std::to_string(told.strokes) + " " + step + "s";
}

void ask_or_quit(SessionState& state) {
    AskedClose& asked = state.asked;
    if (!is_unsaved(state)) {
        state.quit = true;
        return;
    }
    if (asked.closing != Closing::no) return;
    asked.naming.reset();
    const bool saves = asked.told->is == DocumentIs::saving && asked.rests_s >= kKnownAfter_s;
    asked.closing = saves ? Closing::saving : Closing::asked;
    asked.saves_before = asked.told->saves;
}

void stay(SessionState& state) {
    state.asked.closing = Closing::no;
    state.asked.naming.reset();
}

void order_save(SessionState& state, SessionOrders& orders, const std::string& name, bool replaces) {
    AskedSave save;
    save.text = name;
    save.line = orders.line;
    save.replaces = replaces;
    save.after = orders.carving.size();
    save.after_goes = orders.goes.size();
    save.world = state.world;
    save.edits = state.edits;
    save.history = state.history;
    orders.saves.push_back(std::move(save));
    AskedClose& asked = state.asked;
    const bool named_to_close = asked.naming.has_value() && asked.closing == Closing::asked;
    asked.naming.reset();
    if (!named_to_close) return;
    asked.closing = Closing::saving;
    asked.saves_before = asked.told->saves;
}

void save_or_name(SessionState& state, SessionOrders& orders) {
    const AskedClose& asked = state.asked;
    if (asked.told && !asked.told->has_file)
        state.asked.naming = Naming{asked.told->name};
    else
        order_save(state, orders, {}, false);
}

void save_and_quit(SessionState& state, SessionOrders& orders) {
    AskedClose& asked = state.asked;
    if (!asked.told) {
        order_save(state, orders, {}, false);
        state.quit = true;  // after it is saved, as a session ends with all that it was asked for
        return;
    }
    asked.closing = Closing::asked;
    save_or_name(state, orders);
    if (asked.naming) return;
    asked.closing = Closing::saving;
    asked.saves_before = asked.told->saves;
}

void take_told(SessionState& state, const DocumentTold& told) {
    AskedClose& asked = state.asked;
    asked.told = told;
    if (asked.closing != Closing::saving || told.is == DocumentIs::saving || told.saves == asked.saves_before) return;
    if (told.is == DocumentIs::saved) state.quit = true;
    asked.closing = told.is == DocumentIs::changed ? Closing::asked : Closing::no;
}

void open_or_close_naming(SessionState& state) {
    AskedClose& asked = state.asked;
    if (asked.naming || !asked.told || asked.closing == Closing::saving)
        asked.naming.reset();
    else
        asked.naming = Naming{asked.told->name};
}

void save_as(SessionState& state, SessionOrders& orders, const std::string& name, NameIs is) {
    AskedClose& asked = state.asked;
    if (!asked.told || is == NameIs::free || is == NameIs::replaced)
        return order_save(state, orders, name, is == NameIs::replaced);
    asked.naming = Naming{name, is, is == NameIs::given};
    if (is == NameIs::given) orders.names.push_back({.text = name, .line = orders.line});
}

}  // namespace burin::session
