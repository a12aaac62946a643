// SPDX-License-Identifier: MIT
#include "study/assign/sealed_list.hpp"

#include <algorithm>
#include <charconv>

#include "base/sha256.hpp"
#include "base/text.hpp"

namespace burin::study {
namespace {

constexpr std::size_t kSealedBytes = 64;
constexpr std::string_view kHexDigits = "0123456789abcdef";

std::string key_of_place(const std::string& key, const std::string& stratum, std::size_t position) {
    return key + "\n" + stratum + "\n" + std::to_string(position) + "\n";
}

std::size_t hex_value(char digit) {
    const std::size_t value = kHexDigits.find(digit);
    return value == std::string_view::npos ? 0 : value;
}

// Adds the place's own stream of bits; twice gives the text back.
std::string ciphered(const std::string& text, const std::string& place) {
    const std::string stream = sha256(place + "1") + sha256(place + "2");
    std::string out = text;
    for (std::size_t i = 0; i < out.size() && 2 * i + 1 < stream.size(); ++i) {
        const std::size_t bits = 16 * hex_value(stream[2 * i]) + hex_value(stream[2 * i + 1]);
        out[i] = static_cast<char>(static_cast<unsigned char>(out[i]) ^ static_cast<unsigned char>(bits));
    }
    return out;
}

std::string to_hex(const std::string& bytes) {
    std::string hex;
    for (const char c : bytes) {
        const auto value = static_cast<unsigned char>(c);
        hex += kHexDigits[value / 16];
        hex += kHexDigits[value % 16];
    }
    return hex;
}

std::string from_hex(std::string_view hex) {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
        bytes += static_cast<char>(16 * hex_value(hex[i]) + hex_value(hex[i + 1]));
    return bytes;
}

// The line of a place, and nothing where there is none.
std::string_view line_of_place(std::string_view sealed, const std::string& stratum, std::size_t position) {
    const std::string begin = stratum + " " + std::to_string(position) + " ";
    while (!sealed.empty()) {
        const std::size_t end = std::min(sealed.find('\n'), sealed.size());
        if (sealed.substr(0, end).starts_with(begin)) return sealed.substr(begin.size(), end - begin.size());
        sealed.remove_prefix(std::min(end + 1, sealed.size()));
    }
    return {};
}

}  // namespace

std::string seal_allocation(const Protocol& protocol, const std::vector<std::vector<AllocationPlace>>& lists,
                            const std::string& key) {
    std::string text;
    const auto strata = combinations(protocol.strata);
    BURIN_CHECK(strata.size() == lists.size());
    for (std::size_t s = 0; s < std::min(strata.size(), lists.size()); ++s) {
        const std::string label = stratum_label(strata[s]);
        for (std::size_t i = 0; i < lists[s].size(); ++i) {
            const AllocationPlace& at = lists[s][i];
            std::string plain = std::to_string(at.block) + " " + protocol.groups[at.group].code;
            plain.resize(kSealedBytes, ' ');
            const std::string place = key_of_place(key, label, i + 1);
            text += label + " " + std::to_string(i + 1) + " " + to_hex(ciphered(plain, place)) + " " +
                    sha256(place + plain) + "\n";
        }
    }
    return text;
}

std::size_t places_in(std::string_view sealed, const std::string& stratum) {
    std::size_t places = 0;
    while (!sealed.empty()) {
        const std::size_t end = std::min(sealed.find('\n'), sealed.size());
        places += sealed.substr(0, end).starts_with(stratum + " ") ? 1 : 0;
        sealed.remove_prefix(std::min(end + 1, sealed.size()));
    }
    return places;
}

Result<AllocationPlace> open_place(std::string_view sealed, const Protocol& protocol, const std::string& key,
                                   const std::string& stratum, std::size_t position) {
    const std::string_view line = line_of_place(sealed, stratum, position);
    if (line.empty()) {
        return fail("the allocation",
                    formatted("all %zu places of stratum %s are taken", places_in(sealed, stratum), stratum.c_str()),
                    "make a study with more --participants");
    }
    const std::size_t space = std::min(line.find(' '), line.size() - 1);
    const std::string place = key_of_place(key, stratum, position);
    const std::string plain = ciphered(from_hex(line.substr(0, space)), place);
    if (sha256(place + plain) != line.substr(space + 1))
        return fail("the allocation", formatted("place %zu of stratum %s does not open", position, stratum.c_str()),
                    "give the key that burin study init made with this study, or restore allocation.sealed");
    AllocationPlace at;
    const char *const begin = plain.data(), *const end = begin + plain.size();
    const auto [after, failed] = std::from_chars(begin, end, at.block);
    std::string_view code(after, end);
    code = code.substr(std::min(code.find_first_not_of(' '), code.size()));
    code = code.substr(0, std::min(code.find(' '), code.size()));
    const auto group = std::ranges::find(protocol.groups, code, &Group::code);
    if (failed != std::errc() || group == protocol.groups.end())
        return fail("the allocation", formatted("place %zu of stratum %s names no group", position, stratum.c_str()),
                    "restore allocation.sealed");
    at.group = static_cast<std::size_t>(group - protocol.groups.begin());
    return at;
}

}  // namespace burin::study
