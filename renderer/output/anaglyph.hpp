// SPDX-License-Identifier: MIT
// The colour matrices of the anaglyph modes: the light that reaches each eye through its filter is, by least squares
// over the spectra of filters, displays and eyes, as near as possible to what that eye should see. In linear light.
//
// Method: Dubois, "A projection method to generate anaglyph stereo images", ICASSP 2001. Numbers: the matrices that the
// author publishes for LCD displays (Dubois, "Conversion of a stereo pair to anaglyph with the least-squares projection
// method", University of Ottawa, 2009, https://www.site.uottawa.ca/~edubois/anaglyph/): red-cyan, green-magenta and
// amber-blue. The red-cyan pair is the one for glasses and monitors in general, from the same source.
// The numbers stand in shaders/shared/output_rules.h, which the shaders use too. White is preserved to within 0.2 %.
// Results outside 0..1 are clamped.
#pragma once

#include "base/space.hpp"
#include "wall/stereo_mode.hpp"

namespace burin::renderer {

struct AnaglyphMatrices {
    glm::dmat3 left, right;  // light shown = left * light of the left picture + right * light of the right one
};

// mode is one of the three anaglyph modes.
[[nodiscard]] AnaglyphMatrices anaglyph_matrices(wall::StereoMode mode);
[[nodiscard]] bool is_anaglyph(wall::StereoMode mode);

}  // namespace burin::renderer
