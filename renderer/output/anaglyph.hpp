// SPDX-License-Identifier: MIT
// The colour mixtures of the anaglyph modes: what reaches each eye through its filter is as near as can be, by least squares
// over the spectra of filters, displays and eyes, to what that eye should see. In linear light.
//
// Method: Dubois, "A projection method to generate anaglyph stereo images", ICASSP 2001. Numbers: the matrices that the
// author publishes for LCD displays (Dubois, "Conversion of a stereo pair to anaglyph with the least-squares projection
// method", University of Ottawa, 2009, https://www.site.uottawa.ca/~edubois/anaglyph/): red-cyan, green-magenta and
// amber-blue. The red-cyan pair is the one for glasses and monitors in general, from the same place.
// White stays white to within 0.2 %. What falls outside 0..1 is cut off.
#pragma once

#include "base/space.hpp"
#include "renderer/output/stereo_mode.hpp"

namespace burin {

struct AnaglyphMatrices {
    glm::dmat3 left, right;  // light shown = left * light of the left picture + right * light of the right one
};

// mode is one of the three anaglyphs.
[[nodiscard]] AnaglyphMatrices anaglyph_matrices(StereoMode mode);
[[nodiscard]] bool is_anaglyph(StereoMode mode);

}  // namespace burin
