// Which way round a file's rows lie.
#pragma once

#include "image/byte_span.hpp"
#include "image/picture.hpp"

namespace raytracer {

struct Orientation {
  bool is_sideways = false;       ///< a stored row is a column of the picture, else a row
  bool is_right_to_left = false;  ///< columns
  bool is_bottom_up = false;      ///< rows
};

/// What was stored with that orientation, turned to rows from the top left.
Picture turned(Picture stored, const Orientation& orientation);

/// What the tag Orientation of a block of EXIF data says; the usual one where it says nothing that can be
/// understood. `exif` is the TIFF structure, without "Exif" in front (CIPA DC-008-2019, sections 4.5 and
/// 4.6.4).
Orientation exif_orientation(ByteSpan exif);

}  // namespace raytracer
