// SPDX-License-Identifier: Apache-2.0
#include "watercolour/style.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "colour/colour.h"
#include "leafhull/error.h"
#include "text/choice.h"
#include "text/numbers.h"
#include "text/text.h"

namespace leafhull {

extern const std::string_view style_classic;
extern const std::string_view style_wet;
extern const std::string_view style_dry;

namespace watercolour {
namespace {

using Json = nlohmann::json;

constexpr std::array<std::string_view, 3> kNames{"classic", "wet", "dry"};
constexpr float kMostSeed = 1e6f;

/// A file that is read, for messages.
struct Source {
  std::string file;

  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const {
    throw Error(ErrorCode::usage, printable(file, 1000) + ": " + printable(what, 300), remedy);
  }
};

std::string in_quotes(std::string_view name) {
  std::string text = "'";
  return text.append(printable(name)).append("'");
}

Vec3f parse_color(const Json& value, const std::string& key, const Source& source) {
  const auto text = value.is_string() ? value.get<std::string>() : std::string();
  unsigned r = 0, g = 0, b = 0;
  const bool hex = text.size() == 7 && text[0] == '#' &&
                   text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
  if (!hex || std::sscanf(text.c_str(), "#%2x%2x%2x", &r, &g, &b) != 3) {
    source.fail("the key " + in_quotes(key) + " is " + value.dump() + ", which is not a colour",
                "Give it as in \"#7a9f3c\".");
  }
  return Vec3f(static_cast<float>(r), static_cast<float>(g), static_cast<float>(b)) / 255.0f;
}

double parse_number(const Json& value, const StyleKey& key, const std::string& name,
                    const Source& source) {
  const std::string remedy = "It is a number in " + std::string(key.range) + ".";
  if (!value.is_number()) {
    source.fail("the key " + in_quotes(name) + " is " + value.dump() + ", which is not a number",
                remedy);
  }
  const double number = value.get<double>();
  if (number < key.low || number > key.high) {
    source.fail("the key " + in_quotes(name) + " is out of range: " + value.dump(), remedy);
  }
  return number;
}

/// Sets the member of a Style or a Wash.
template <class Target>
void set(Target& target, const StyleKey& key, const std::string& name, const Json& value,
         const Source& source) {
  if (const auto* color = std::get_if<Vec3f Target::*>(&key.member)) {
    target.*(*color) = parse_color(value, name, source);
  } else if (const auto* number = std::get_if<float Target::*>(&key.member)) {
    target.*(*number) = static_cast<float>(parse_number(value, key, name, source));
  } else if constexpr (std::is_same_v<Target, Style>) {
    const double seed = parse_number(value, key, name, source);
    if (seed != std::floor(seed)) {
      source.fail("the key " + in_quotes(name) + " is " + value.dump() + ", not a whole number",
                  "It is a whole number in " + std::string(key.range) + ".");
    }
    target.seed = static_cast<std::uint32_t>(seed);
  }
}

template <class Row>
const Row* find(std::span<const Row> rows, std::string_view name) {
  for (const Row& row : rows) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

template <class Row>
std::string listing(std::span<const Row> rows) {
  return joined(rows, ", ", &Row::name);
}

void read_wash(Wash& wash, const std::string& name, const Json& object, const Source& source) {
  if (!object.is_object()) {
    source.fail("the key " + in_quotes(name) + " is " + object.dump() + ", which is not a wash",
                "A wash is an object with some of the keys " + listing(wash_keys()) + ".");
  }
  for (const auto& [key, value] : object.items()) {
    std::string full_name = name;
    full_name.append(".").append(key);
    const StyleKey* row = find(wash_keys(), key);
    if (!row) {
      source.fail("there is no key " + in_quotes(full_name),
                  "A wash has the keys " + listing(wash_keys()) + ".");
    }
    set(wash, *row, full_name, value, source);
  }
}

void read_style(Style& style, const Json& object, const Source& source) {
  for (const auto& [key, value] : object.items()) {
    if (key == "base") continue;
    if (const WashName* wash = find(wash_names(), key)) {
      read_wash(style.*(wash->wash), key, value, source);
    } else if (const StyleKey* row = find(style_keys(), key)) {
      set(style, *row, key, value, source);
    } else {
      source.fail("there is no key " + in_quotes(key),
                  "A style has the keys base, " + listing(style_keys()) + "; and the washes " +
                      listing(wash_names()) + ".");
    }
  }
}

Json parse_json(std::string_view text, const Source& source) {
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::out_of_range& error) {
    const std::string_view what = error.what();  // ends with the number in quotes
    source.fail("a number is too large: " + std::string(what.substr(what.find('\''))),
                "Give a number in the range of its key.");
  } catch (const Json::exception& error) {
    source.fail(std::string("not JSON: ") + error.what(),
                "Give a style file, such as those in styles/.");
  }
  if (!json.is_object())
    source.fail("not a JSON object", "Give a style file, such as those in styles/.");
  return json;
}

std::string base_of(const Json& json, const Source& source) {
  if (!json.contains("base")) return std::string(kNames[0]);
  const Json& base = json["base"];
  for (const std::string_view name : kNames) {
    if (base.is_string() && base.get<std::string>() == name) return std::string(name);
  }
  source.fail("the key 'base' is " + base.dump() + ", which names no style",
              "There are: " + joined(kNames, ", ") + ".");
}

std::string_view text_of(std::string_view name) {
  if (name == "classic") return style_classic;
  if (name == "wet") return style_wet;
  if (name == "dry") return style_dry;
  throw Error(ErrorCode::usage, "there is no watercolour style " + in_quotes(name),
              "There are: " + joined(kNames, ", ") + ".");
}

/// @throws Error internal: a key is not there.
void require_all_keys(const Json& json, std::string_view name) {
  const auto require = [&](const Json& object, std::string_view key) {
    if (object.contains(key)) return;
    throw Error(ErrorCode::internal,
                "the style " + in_quotes(name) + " lacks the key " + in_quotes(key));
  };
  for (const StyleKey& key : style_keys()) require(json, key.name);
  for (const WashName& wash : wash_names()) {
    require(json, wash.name);
    for (const StyleKey& key : wash_keys()) require(json[std::string(wash.name)], key.name);
  }
}

/// Writes a row of the table; colours are written as in style files.
template <class Target>
std::string table_row(const StyleKey& key, const std::string& name, const Target& target) {
  std::string value;
  if (const auto* color = std::get_if<Vec3f Target::*>(&key.member)) {
    const auto byte = [](float part) { return static_cast<std::uint8_t>(std::lround(255 * part)); };
    const Vec3f c = target.*(*color);
    value = hex_of(std::array{byte(c.x), byte(c.y), byte(c.z)});
  } else if (const auto* number = std::get_if<float Target::*>(&key.member)) {
    value = significant(double{target.*(*number)}, 6);
  } else if constexpr (std::is_same_v<Target, Style>) {
    value = std::to_string(target.seed);
  }
  return "| `" + name + "` | " + std::string(key.range) + " | " + value + " | " +
         std::string(key.help) + " |\n";
}

}  // namespace

std::string style_table() {
  const Style style = shipped_style(kNames[0]);
  std::string table = "| key | range | default | |\n|---|---|---|---|\n";
  for (const StyleKey& key : style_keys()) table += table_row(key, std::string(key.name), style);
  for (const WashName& wash : wash_names()) {
    for (const StyleKey& key : wash_keys()) {
      std::string name(wash.name);
      name.append(".").append(key.name);
      table += table_row(key, name, style.*(wash.wash));
    }
  }
  return table;
}

std::span<const std::string_view> style_names() { return kNames; }

Style shipped_style(std::string_view name) {
  const std::string_view text = text_of(name);
  if (name != kNames[0]) return parse_style(text, std::string(name));
  Style style;
  const Source source{std::string(name)};
  const Json json = parse_json(text, source);
  require_all_keys(json, name);
  read_style(style, json, source);
  return style;
}

Style parse_style(std::string_view text, const std::string& file) {
  const Source source{file};
  const Json json = parse_json(text, source);
  Style style = shipped_style(base_of(json, source));
  read_style(style, json, source);
  return style;
}

std::span<const StyleKey> style_keys() {
  static const StyleKey keys[] = {
      {"seed", "[0, 1000000]", "another paper and other patches", &Style::seed, 0, kMostSeed},
      {"paper", "a colour", "the paper's colour", &Style::paper},
      {"grain", "[0.001, 0.1]", "the width of the paper's grain", &Style::grain, 0.001f, 0.1f},
      {"roughness", "[0, 3]", "how much paint feels the paper's grain", &Style::roughness, 0, 3},
      {"relief", "[0, 1]", "how much the light shows the paper's grain", &Style::relief, 0, 1},
      {"sky", "[0, 1]", "the sky's share of the light that tones are read from", &Style::sky, 0, 1},
      {"dilution", "[0, 1]", "how much the lights are thinned towards the paper", &Style::dilution,
       0, 1},
      {"warm_cool", "[0, 2]", "how far colours lean to warm and cool across the crown",
       &Style::warm_cool, 0, 2},
      {"turbulence", "[0, 2]", "unevenness of the pigment in the water", &Style::turbulence, 0, 2},
      {"backruns", "[0, 2]", "fronts of pigment where water flowed back", &Style::backruns, 0, 2},
      {"eddies", "[0.1, 100]", "how many eddies lie across the scene", &Style::eddies, 0.1f, 100},
      {"dispersion", "[0, 2]", "specks of pigment", &Style::dispersion, 0, 2},
      {"bleeding", "[0, 1]", "how much wet patches run into each other", &Style::bleeding, 0, 1},
      {"bleeding_width", "[0, 0.1]", "how far they run", &Style::bleeding_width, 0, 0.1f},
      {"edge_width", "[0, 0.05]", "the width of dark rims", &Style::edge_width, 0, 0.05f},
      {"wobble", "[0, 1]", "how an edge sways", &Style::wobble, 0, 1},
      {"melting", "[0.001, 1]", "how far behind another a mass has melted away", &Style::melting,
       0.001f, 1},
      {"melting_width", "[0.001, 0.1]", "how far around masses melt", &Style::melting_width, 0.001f,
       0.1f},
      {"melting_softness", "[0, 0.1]", "softens the edges of masses in front",
       &Style::melting_softness, 0, 0.1f},
      {"gaps", "[0, 1]", "paper left free behind a mass in front", &Style::gaps, 0, 1},
      {"ground_reach", "[0.01, 5]", "reach of the wash at the foot, in half crowns",
       &Style::ground_reach, 0.01f, 5},
      {"detail", "[0, 1]", "how many leaves are painted one by one", &Style::detail, 0, 1},
      {"leaf_size", "[0.1, 10]", "the size of a stroke, in leaves", &Style::leaf_size, 0.1f, 10},
      {"leaf_width", "[0.0001, 0.1]", "the least half-length of a stroke", &Style::leaf_width,
       0.0001f, 0.1f},
  };
  return keys;
}

std::span<const StyleKey> wash_keys() {
  static const StyleKey keys[] = {
      {"cool", "a colour", "colour of a coat on white paper where it leans cool", &Wash::cool},
      {"warm", "a colour", "colour of a coat on white paper where it leans warm", &Wash::warm},
      {"strength", "[0, 5]", "pigment in the water", &Wash::strength, 0, 5},
      {"level", "[0, 1]", "how dark, or how far inside, it begins", &Wash::level, 0, 1},
      {"size", "[0, 0.1]", "size of the shapes it is simplified to", &Wash::size, 0, 0.1f},
      {"wetness", "[0, 1]", "its edges: 0 wet on dry, 1 wet on wet", &Wash::wetness, 0, 1},
      {"lost_edges", "[0, 1]", "how much wetter edges are in patches", &Wash::lost_edges, 0, 1},
      {"edge_darkening", "[0, 10]", "pigment carried to the rim", &Wash::edge_darkening, 0, 10},
      {"granulation", "[0, 5]", "pigment in the valleys of the paper", &Wash::granulation, 0, 5},
      {"raggedness", "[0, 1]", "how leaves break its edge", &Wash::raggedness, 0, 1},
      {"dry_brush", "[0, 2]", "how the paper's peaks break its edge", &Wash::dry_brush, 0, 2},
  };
  return keys;
}

std::span<const WashName> wash_names() {
  static const WashName names[] = {
      {"ambient", "over all the foliage", &Style::ambient},
      {"tone", "over what the light does not reach in full", &Style::tone},
      {"shadow", "over the darkest", &Style::shadow},
      {"wood", "over trunk and branches", &Style::wood},
      {"wood_shadow", "over their dark side", &Style::wood_shadow},
      {"leaves", "strokes of single leaves", &Style::leaves},
      {"ground", "at the foot", &Style::ground},
  };
  return names;
}

}  // namespace watercolour
}  // namespace leafhull
