// SPDX-License-Identifier: Apache-2.0
#include "input/image_table.h"

#include <tbb/parallel_pipeline.h>

#include "input/images.h"
#include "input/input_error.h"

namespace leafhull {
namespace {

/// A few bytes can hold 256 MiB of pixels: no more are at hand at once than this beyond the limit.
constexpr std::size_t kAtOnce = 4;
constexpr std::size_t kMostBytes = std::size_t{1} << 31;

}  // namespace

struct ImageTable::Decoded {
  int number = 0;
  Image image{};
  std::vector<std::string> faults{};
};

ImageSource companion_image(const Companions& companions, const std::string& name,
                            std::vector<std::string>& warnings) {
  ImageSource source{.name = name, .place = in_quotes(name)};
  try {
    source.owned = read_companion(companions, name, warnings);
  } catch (const FileError& error) {
    source.fault = error.what();
  }
  return source;
}

int ImageTable::number_of(const ImageNames& names,
                          const std::function<ImageSource(const std::string&)>& load,
                          TreeModel& tree) {
  const auto [known, is_new] = numbers_.emplace(names, static_cast<int>(tree.images.size()));
  if (!is_new) return known->second;
  Entry& entry = entries_.emplace_back(Entry{known->second, {}, {}});
  const auto& [colour, opacity] = names;
  if (!colour.empty()) entry.colour.push_back(load(colour));
  if (!opacity.empty() && opacity != colour) entry.opacity.push_back(load(opacity));
  Image& image = tree.images.emplace_back();
  image.name = (colour.empty() ? entry.opacity : entry.colour).front().name;
  return known->second;
}

ImageTable::Decoded ImageTable::decode(const Entry& entry) {
  Decoded decoded{.number = entry.number};
  const auto read = [&](const ImageSource& source) {
    std::string fault = source.fault;
    Image image;
    if (fault.empty()) image = decode_image(source.bytes(), source.name, fault);
    if (!fault.empty()) decoded.faults.push_back(source.place + ": texture not read: " + fault);
    return image;
  };
  for (const ImageSource& source : entry.colour) decoded.image = read(source);
  for (const ImageSource& source : entry.opacity) {
    Image opacity = read(source);
    if (!opacity.empty()) decoded.image = with_opacity(decoded.image, std::move(opacity));
  }
  return decoded;
}

void ImageTable::decode(TreeModel& tree) const {
  std::size_t next = 0, bytes = 0;
  const auto take = [&](tbb::flow_control& control) {
    if (next == entries_.size()) control.stop();
    return next++;
  };
  const auto keep = [&](Decoded decoded) {
    Image& image = tree.images[static_cast<std::size_t>(decoded.number)];
    bytes += decoded.image.rgba.size();
    if (bytes > kMostBytes) {
      bytes -= decoded.image.rgba.size();
      decoded.image = {};
      decoded.faults.push_back(in_quotes(image.name) +
                               ": texture not read: the images of the file are larger than 2 GiB "
                               "together");
    }
    decoded.image.name = std::move(image.name);
    image = std::move(decoded.image);
    tree.warnings.insert(tree.warnings.end(), decoded.faults.begin(), decoded.faults.end());
  };
  const auto decode_one = [&](std::size_t i) { return decode(entries_[i]); };
  using tbb::filter_mode;
  tbb::parallel_pipeline(
      kAtOnce, tbb::make_filter<void, std::size_t>(filter_mode::serial_in_order, take) &
                   tbb::make_filter<std::size_t, Decoded>(filter_mode::parallel, decode_one) &
                   tbb::make_filter<Decoded, void>(filter_mode::serial_in_order, keep));
}

}  // namespace leafhull
