// SPDX-License-Identifier: Apache-2.0
#include "input/image_table.h"

#include <tbb/parallel_pipeline.h>

#include "input/images.h"
#include "input/input_error.h"

namespace leafhull {
namespace {

/// The number of pictures that are decoded at a time. Each takes its file and up to 256 MiB of
/// pixels, three times that while it is decoded, beyond the pictures that are kept.
constexpr std::size_t kAtOnce = 4;

}  // namespace

struct ImageTable::Decoded {
  int number = 0;
  std::string place{};
  Image image{};
  std::vector<std::string> faults{};
};

ImageSource companion_image(const Companions& companions, const std::string& name,
                            std::vector<std::string>& warnings) {
  ImageSource source{.name = name, .place = in_quotes(name)};
  try {
    const Companions::Found found = companions.find(name);
    if (!found.note.empty()) warnings.push_back(found.note);
    source.load = [file = found.path] { return read_file(file); };
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
    try {
      const Bytes owned = source.load ? source.load() : Bytes();
      if (fault.empty()) {
        image = decode_image(source.load ? ByteSpan(owned) : source.lent, source.name, fault);
      }
    } catch (const FileError& error) {
      fault = error.what();
    }
    if (decoded.place.empty()) decoded.place = source.place;
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
    if (bytes > most_bytes_) {
      bytes -= decoded.image.rgba.size();
      decoded.image = {};
      decoded.faults.push_back(decoded.place +
                               ": texture not read: the images of the file are "
                               "larger than 2 GiB together");
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
