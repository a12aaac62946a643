// SPDX-License-Identifier: MIT
// The solid's rays and ends as the device stores them, for compute shaders. Include after declaring the push constants
// `parameters` with a field store_address, and `rays`. The store is accessed by its address, not by a binding, so it
// may exceed the largest size of a binding (128 MiB on some drivers).
layout(buffer_reference, std430, buffer_reference_align = 8) buffer Ends { DexelEnd at[]; };

Ends store = Ends(parameters.store_address);
