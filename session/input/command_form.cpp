// SPDX-License-Identifier: MIT
#include "session/input/command_form.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "base/near_name.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "session/input/input_words.hpp"

namespace burin::session {
namespace {

// Returns the finite number that the whole word is.
std::optional<double> finite_number(std::string_view word) {
    double value = 0.0;
    const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (failed != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

std::string range_text(const ArgumentKind& kind) {
    const std::string range = formatted("a number from %.12g to %.12g", kind.least, kind.most);
    return kind.unit.empty() ? range : range + ", in " + std::string(kind.unit);
}

std::string what_text(const ArgumentKind& kind) {
    switch (kind.what) {
        case ArgumentKind::What::text: return {};
        case ArgumentKind::What::number: return range_text(kind);
        case ArgumentKind::What::name: return "one of " + joined(kind.names);
        case ArgumentKind::What::colour: return "red,green,blue from 0 to 1";
    }
    return {};
}

Result<void> check_word(const ArgumentKind& kind, const std::string& word, const std::string& command) {
    switch (kind.what) {
        case ArgumentKind::What::text: break;
        case ArgumentKind::What::number: BURIN_TRY_DO(read_number(word, kind, command + " " + word)); break;
        case ArgumentKind::What::name: BURIN_TRY_DO(read_name(word, kind.names, command)); break;
        case ArgumentKind::What::colour: BURIN_TRY_DO(read_colour(word, command + " " + word)); break;
    }
    return {};
}

}  // namespace

std::string text_of(const CommandForm& form) {
    std::string text(form.name), kinds;
    if (!form.arguments.empty()) text += " " + std::string(form.arguments);
    for (const ArgumentKind& kind : form.kinds)
        if (kind.what != ArgumentKind::What::text) kinds += (kinds.empty() ? "" : "; ") + what_text(kind);
    return kinds.empty() ? text : text + " (" + kinds + ")";
}

Result<void> check_words(const CommandForm& form, std::span<const std::string> words, std::string_view before) {
    const bool optional = form.arguments.starts_with('['), more = form.arguments.ends_with("...");
    const auto most =
        form.arguments.empty() ? std::size_t{0} : static_cast<std::size_t>(1 + std::ranges::count(form.arguments, ' '));
    const std::string command = "command " + std::string(before) + std::string(form.name);
    const std::string remedy = "write " + std::string(before) + text_of(form);
    if (words.size() > most && !more)
        return fail(command,
                    most == 0 ? "takes no argument, and is given " + as_word(words[0])
                              : "is given one word too many: " + as_word(words[most]),
                    remedy);
    if (words.size() < most && !optional)
        return fail(command, most == 1 ? "lacks its argument" : "lacks an argument", remedy);
    for (std::size_t i = 0; i < std::min(words.size(), form.kinds.size()); ++i)
        BURIN_TRY_DO(check_word(form.kinds.at(i), words[i], command));
    return {};
}

Result<double> read_number(const std::string& word, const ArgumentKind& kind, const std::string& where) {
    const std::optional<double> number = finite_number(word);
    if (!number) return fail(where, "is not a number", "write " + range_text(kind));
    if (*number < kind.least || *number > kind.most)
        return fail(where, "is out of bounds", "write " + range_text(kind));
    return *number;
}

Result<std::size_t> read_name(std::string_view word, std::span<const std::string_view> names,
                              const std::string& command) {
    const auto at = std::ranges::find(names, word);
    if (at != names.end()) return static_cast<std::size_t>(at - names.begin());
    return fail(command + (word.empty() ? "" : " " + std::string(word)),
                word.empty() ? "says not what" : "is not known", meant_by(word, names) + "There are " + joined(names));
}

Result<std::array<double, 3>> read_colour(const std::string& word, const std::string& where) {
    const char* const remedy = "write red,green,blue from 0 to 1, such as 0.8,0.2,0.1";
    std::array<double, 3> srgb{};
    std::string_view rest = word;
    for (std::size_t i = 0; i < srgb.size(); ++i) {
        const std::size_t comma = i + 1 < srgb.size() ? rest.find(',') : rest.size();
        const auto part = comma == std::string_view::npos ? std::nullopt : finite_number(rest.substr(0, comma));
        if (!part) return fail(where, "is no colour", remedy);
        srgb.at(i) = *part;
        rest.remove_prefix(std::min(comma + 1, rest.size()));
    }
    if (std::ranges::any_of(srgb, [](double part) { return part < 0.0 || part > 1.0; }))
        return fail(where, "is out of bounds", remedy);
    return srgb;
}

double number_of(const std::string& word) {
    return finite_number(word).value_or(std::numeric_limits<double>::quiet_NaN());
}

std::string exact_word(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end.ptr};
}

std::string exact_word(const std::array<double, 3>& srgb) {
    return exact_word(srgb[0]) + "," + exact_word(srgb[1]) + "," + exact_word(srgb[2]);
}

}  // namespace burin::session
