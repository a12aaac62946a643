// SPDX-License-Identifier: MIT
// What a part of a scene keeps of itself in a document: pages of bytes, whose meaning the part alone knows.
//
// A page is what is read, checked and written as a whole: a tile of a solid, a head with what holds for all of it.
// Plain data. A part makes it on its thread, a document's writer takes it over (document/document_writer.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace burin::scene {

struct PageName {
    std::string kind;  // of the part's choice: "head", "rays x"
    std::int64_t number = 0;

    friend auto operator<=>(const PageName&, const PageName&) = default;
};

struct Pages {
    std::string part = {};  // the kind of part that can load them: "tri-dexel solid"
    // Asked of save(): all pages, and not those alone that have changed since the last call.
    bool whole = true;
    std::map<PageName, std::vector<std::byte>> pages = {};
    std::vector<PageName> damaged = {};  // that the document has and that cannot be read

    // Returns null where there is no such page.
    [[nodiscard]] const std::vector<std::byte>* find(const PageName& name) const {
        const auto at = pages.find(name);
        return at != pages.end() ? &at->second : nullptr;
    }
};

}  // namespace burin::scene
