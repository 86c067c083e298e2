// SPDX-License-Identifier: Apache-2.0
// Pictures in other formats, by the program rsvg-convert (librsvg, cairo).

#pragma once

#include <string>

namespace stiction {

// The SVG as "png", twice as many pixels as it names, or "pdf". The same bytes of the same version of that
// program. InputError where it is not installed, or fails.
std::string Converted(const std::string& svg, const std::string& format);

}  // namespace stiction
