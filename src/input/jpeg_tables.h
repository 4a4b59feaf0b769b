// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "input/file_bytes.h"

namespace leafhull {

/// Whether the Huffman tables of a JPEG file hold no more codes than there are bytes, and whether
/// all Huffman and quantisation tables that its scans use exist. stb_image does not check: before
/// version 2.29 it writes past the end of larger tables, and missing tables are uninitialised.
bool has_sound_tables(ByteSpan jpeg);

}  // namespace leafhull
