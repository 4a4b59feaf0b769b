// SPDX-License-Identifier: Apache-2.0
#include "input/jpeg_tables.h"

#include <algorithm>
#include <array>

namespace leafhull {
namespace {

/// Goes from marker to marker as stb_image does, and stops where stb_image gives up.
class TableCheck {
 public:
  explicit TableCheck(ByteSpan jpeg) : jpeg_(jpeg) {}

  bool run() {
    int marker = take_marker();  // the start-of-image marker, which has no length
    for (bool sound = true; sound;) {
      marker = marker == kScan ? marker_after_scan() : take_marker();
      switch (marker) {
        case kHuffman:
          sound = segment(&TableCheck::huffman);
          break;
        case kQuantisation:
          sound = segment(&TableCheck::quantisation);
          break;
        case kScan:
          sound = segment(&TableCheck::scan);
          break;
        case 0xC0:
        case 0xC1:
        case kProgressive:
          progressive_ = marker == kProgressive;
          sound = segment(&TableCheck::frame);
          break;
        default:
          if (!has_length(marker)) return (used_ & ~quantisation_) == 0;
          segment(&TableCheck::passed_over);
      }
    }
    return false;
  }

 private:
  static constexpr int kProgressive = 0xC2, kHuffman = 0xC4, kScan = 0xDA, kQuantisation = 0xDB;

  static bool has_length(int marker) {
    return (marker >= 0xE0 && marker <= 0xEF) || marker == 0xFE || marker == 0xDC || marker == 0xDD;
  }

  bool at_end() const { return at_ >= jpeg_.size(); }
  int take() { return at_end() ? 0 : jpeg_[at_++]; }

  int take_marker() {
    while (!at_end() && take() != 0xFF) {
    }
    int marker = 0;
    while (!at_end() && (marker = take()) == 0xFF) {
    }
    return marker;
  }

  /// The marker that ends a scan. Within a scan, 0xFF before a zero is no marker, and markers 0xD0
  /// to 0xD7 belong to the scan.
  int marker_after_scan() {
    int marker = 0;
    do {
      marker = take_marker();
    } while (!at_end() && (marker == 0 || (marker >= 0xD0 && marker <= 0xD7)));
    return marker;
  }

  bool segment(bool (TableCheck::*check)()) {
    const std::size_t begin = at_;
    const int high = take(), length = std::max(256 * high + take(), 2);
    end_ = std::min(begin + length, jpeg_.size());
    const bool sound = (this->*check)();
    at_ = end_;
    return sound;
  }

  bool passed_over() { return true; }

  bool huffman() {
    while (at_ < end_) {
      const int table = take();
      int codes = 0;
      for (int length = 1; length <= 16; ++length) codes += take();
      if (codes > 256) return false;
      at_ += codes;
      huffman_ |= bit(table & 15, table >> 4);
    }
    return true;
  }

  bool quantisation() {
    while (at_ < end_) {
      const int table = take();
      at_ += table >> 4 ? 128 : 64;
      quantisation_ |= bit(table & 15, 0);
    }
    return true;
  }

  bool frame() {
    at_ += 5;
    for (int count = take(); count > 0 && !at_end(); --count) {
      at_ += 2;
      used_ |= bit(take(), 0);
    }
    return true;
  }

  bool scan() {
    std::array<unsigned, 2> used{};  // tables for a block's mean, and for the rest
    for (int count = take(); count > 0 && !at_end(); --count) {
      take();
      const int tables = take();
      used[0] |= bit(tables >> 4, 0);
      used[1] |= bit(tables & 15, 1);
    }
    const bool has_mean = !progressive_ || take() == 0;
    take();
    const bool is_first = !progressive_ || take() >> 4 == 0;
    unsigned needed = 0;
    if (!progressive_ || (has_mean && is_first)) needed |= used[0];
    if (!progressive_ || !has_mean) needed |= used[1];
    return (needed & ~huffman_) == 0;
  }

  /// The bit of a table in a set, by its number and kind; there are four tables of each kind.
  static unsigned bit(int number, int kind) {
    return number > 3 ? 0 : 1u << (4 * (kind & 1) + number);
  }

  ByteSpan jpeg_;
  std::size_t at_ = 0, end_ = 0;
  bool progressive_ = false;
  unsigned huffman_ = 0, quantisation_ = 0, used_ = 0;
};

}  // namespace

bool has_sound_tables(ByteSpan jpeg) { return TableCheck(jpeg).run(); }

}  // namespace leafhull
