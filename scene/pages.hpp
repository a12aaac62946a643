// SPDX-License-Identifier: MIT
// What a part of a scene keeps of itself in a document: pages of bytes, whose meaning the part alone knows.
//
// A page is what is read, checked and written as a whole: a tile of a solid, a head with what holds for all of it.
// Plain data. A part makes it on its thread, a document's writer takes it over (document/document_writer.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace burin::scene {

struct PageName {
    std::string kind;  // of the part's choice: "head", "rays x"
    std::int64_t number = 0;

    friend auto operator<=>(const PageName&, const PageName&) = default;
};

// Steps from what a part's pages hold to what they held before, and forward again: those numbered first to done lead
// back, the last of them first; those behind, up to last, lead forward.
struct Steps {
    std::int64_t first = 1, done = 0, last = 0;
    // Of the steps that are new since the last call of save(); a page has the number of its step.
    std::map<PageName, std::vector<std::byte>> pages = {};
};

struct Pages {
    std::string part = {};  // the kind of part that can load them: "tri-dexel solid"
    // Asked of save(): all pages, and not those alone that have changed since the last call.
    bool whole = true;
    std::map<PageName, std::vector<std::byte>> pages = {};
    std::optional<Steps> steps = {};     // nothing: there is no way back
    std::vector<PageName> damaged = {};  // that the document has and that cannot be read

    // Returns null where there is no such page.
    [[nodiscard]] const std::vector<std::byte>* find(const PageName& name) const {
        const auto at = pages.find(name);
        return at != pages.end() ? &at->second : nullptr;
    }
};

}  // namespace burin::scene
