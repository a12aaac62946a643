// SPDX-License-Identifier: MIT
#include "desk/panel/fallback_type.hpp"

#include <fontconfig/fontconfig.h>

#include <memory>

namespace burin::session::panel {
namespace {

template <typename T, void (*destroy)(T*)>
struct Destroy {
    void operator()(T* it) const { destroy(it); }
};
template <typename T, void (*destroy)(T*)>
using Owned = std::unique_ptr<T, Destroy<T, destroy>>;
using OwnedPattern = Owned<FcPattern, FcPatternDestroy>;

}  // namespace

std::optional<FallbackType> type_with(std::span<const std::uint32_t> letters) {
    if (letters.empty() || FcInit() == FcFalse) return std::nullopt;
    const Owned<FcCharSet, FcCharSetDestroy> wanted(FcCharSetCreate());
    for (const std::uint32_t letter : letters) FcCharSetAddChar(wanted.get(), letter);
    const OwnedPattern asked(FcPatternCreate());
    FcPatternAddCharSet(asked.get(), FC_CHARSET, wanted.get());
    FcPatternAddString(asked.get(), FC_FAMILY, reinterpret_cast<const FcChar8*>("sans-serif"));
    FcPatternAddBool(asked.get(), FC_SCALABLE, FcTrue);
    FcConfigSubstitute(nullptr, asked.get(), FcMatchPattern);
    FcDefaultSubstitute(asked.get());
    FcResult result = FcResultNoMatch;
    const OwnedPattern found(FcFontMatch(nullptr, asked.get(), &result));
    if (!found) return std::nullopt;
    FcCharSet* has = nullptr;  // the pattern's, as the file's name is
    FcChar8* file = nullptr;
    int index = 0;
    if (FcPatternGetCharSet(found.get(), FC_CHARSET, 0, &has) != FcResultMatch ||
        FcCharSetIntersectCount(has, wanted.get()) == 0)
        return std::nullopt;
    if (FcPatternGetString(found.get(), FC_FILE, 0, &file) != FcResultMatch) return std::nullopt;
    static_cast<void>(FcPatternGetInteger(found.get(), FC_INDEX, 0, &index));
    return FallbackType{reinterpret_cast<const char*>(file), index & 0xFFFF};
}

}  // namespace burin::session::panel
