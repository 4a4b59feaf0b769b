// SPDX-License-Identifier: Apache-2.0
#include "foliage/names.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace leafhull {
namespace {

/// How a word must stand in a name.
enum class Stands {
  anywhere,  ///< also inside of a longer word
  alone,     ///< as a word of its own: short words occur in others by chance
};

struct Word {
  std::string_view text;  ///< folded
  Growth growth;
  double weight;
  Stands stands = Stands::anywhere;
};

using enum Growth;
using enum Stands;

// Colours and seasons only hint. A word that contains another one (leafless; Nadelbaum, a conifer)
// comes before it. Sources: dictionaries, and the names of public models.
constexpr auto kWords = std::to_array<Word>({
    {"leafless", wood, -1},
    {"no leaves", wood, -1},
    {"no leaf", wood, -1},
    {"laubbaum", unknown, 0},
    {"nadelbaum", unknown, 0},
    {"pinecone", other, -1},
    {"pine cone", other, -1},
    {"coconut", other, -1},
    {"cobweb", other, -1},
    {"apple tree", unknown, 0},
    {"appletree", unknown, 0},
    {"dogwood", unknown, 0},
    {"redwood", unknown, 0},
    {"cottonwood", unknown, 0},
    {"boxwood", unknown, 0},
    {"ironwood", unknown, 0},
    {"rosewood", unknown, 0},
    {"stone pine", unknown, 0},
    {"watermelon", other, -1},
    {"pineapple", unknown, 0},

    // Leaves: English, German, Dutch, Scandinavian, French, Spanish, Portuguese, Italian, Polish,
    // Turkish, Finnish, Indonesian, Russian, Ukrainian, Greek, Chinese, Japanese, Korean, Arabic.
    {"leaf", leaves, 1},
    {"leav", leaves, 1},
    {"foliage", leaves, 1},
    {"needle", leaves, 1},
    {"frond", leaves, 1},
    {"crown", leaves, 1},
    {"canopy", leaves, 1},
    {"treetop", leaves, 1},
    {"tree top", leaves, 1},
    {"blossom", leaves, 1},
    {"petal", leaves, 1},
    {"bloom", leaves, 0.7},
    {"flower", leaves, 0.5},
    {"bush", leaves, 0.8},
    {"shrub", leaves, 0.8},
    {"hedge", leaves, 0.8},
    {"ivy", leaves, 0.8, alone},
    {"leafs", leaves, 1},
    {"foliag", leaves, 1},
    {"foilage", leaves, 1},
    {"folliage", leaves, 1},
    {"blatt", leaves, 1},
    {"blaett", leaves, 1},
    {"laub", leaves, 1, alone},
    {"laubwerk", leaves, 1},
    {"nadel", leaves, 1},
    {"krone", leaves, 1},
    {"blute", leaves, 0.7},
    {"bluete", leaves, 0.7},
    {"busch", leaves, 0.8},
    {"strauch", leaves, 0.8},
    {"blad", leaves, 1, alone},
    {"bladeren", leaves, 1},
    {"naalden", leaves, 1},
    {"kroon", leaves, 1, alone},
    {"lov", leaves, 0.8, alone},
    {"lovverk", leaves, 1},
    {"feuill", leaves, 1},
    {"aiguille", leaves, 1},
    {"houppier", leaves, 1},
    {"frondaison", leaves, 1},
    {"buisson", leaves, 0.8},
    {"hoja", leaves, 1},
    {"follaje", leaves, 1},
    {"aguja", leaves, 1},
    {"copa", leaves, 0.8, alone},
    {"arbusto", leaves, 0.8},
    {"folha", leaves, 1},
    {"agulha", leaves, 1},
    {"foglia", leaves, 1},
    {"foglie", leaves, 1},
    {"aghi", leaves, 1, alone},
    {"chioma", leaves, 1},
    {"cespuglio", leaves, 0.8},
    {"lisc", leaves, 1, alone},
    {"liscie", leaves, 1},
    {"korona", leaves, 1},
    {"yaprak", leaves, 1},
    {"lehti", leaves, 1, alone},
    {"lehdet", leaves, 1},
    {"neulas", leaves, 1},
    {"daun", leaves, 1, alone},
    {"listva", leaves, 1},
    {"listya", leaves, 1},
    {"hvoya", leaves, 1},
    {"лист", leaves, 1},
    {"хвоя", leaves, 1},
    {"хвои", leaves, 1},
    {"крона", leaves, 1},
    {"куст", leaves, 0.8},
    {"φυλλ", leaves, 1},
    {"葉", leaves, 1},
    {"叶", leaves, 1},
    {"樹冠", leaves, 1},
    {"树冠", leaves, 1},
    {"松针", leaves, 1},
    {"花瓣", leaves, 1},
    {"лепест", leaves, 1},
    {"はっぱ", leaves, 1},
    {"잎", leaves, 1},
    {"ورق", leaves, 1},
    {"green", leaves, 0.5},
    {"grun", leaves, 0.5, alone},
    {"gruen", leaves, 0.5},
    {"vert", leaves, 0.5, alone},
    {"verde", leaves, 0.5},
    {"зелен", leaves, 0.5},
    {"绿", leaves, 0.5},
    {"緑", leaves, 0.5},
    {"autumn", leaves, 0.25},
    {"sakura", leaves, 0.2},
    {"pink", leaves, 0.3, alone},

    // Undergrowth: leaves where there is no tree.
    {"grass", undergrowth, 0.5},
    {"lawn", undergrowth, 0.5, alone},
    {"meadow", undergrowth, 0.5},
    {"turf", undergrowth, 0.5, alone},
    {"weed", undergrowth, 0.5, alone},
    {"weeds", undergrowth, 0.5, alone},
    {"fern", undergrowth, 0.5, alone},
    {"clover", undergrowth, 0.5},
    {"gras", undergrowth, 0.5, alone},
    {"graser", undergrowth, 0.5, alone},
    {"wiese", undergrowth, 0.5},
    {"herbe", undergrowth, 0.5, alone},
    {"hierba", undergrowth, 0.5},
    {"cesped", undergrowth, 0.5},
    {"grama", undergrowth, 0.5, alone},
    {"erba", undergrowth, 0.5, alone},
    {"трава", undergrowth, 0.5},
    {"草", undergrowth, 0.5},

    // Wood.
    {"bark", wood, -1},
    {"trunk", wood, -1},
    {"wood", wood, -1},
    {"stem", wood, -1, alone},
    {"stems", wood, -1, alone},
    {"branch", wood, -0.6},
    {"twig", wood, -0.6},
    {"log", wood, -1, alone},
    {"stump", wood, -1},
    {"roots", wood, -1, alone},
    {"rinde", wood, -1},
    {"borke", wood, -1, alone},
    {"stamm", wood, -1},
    {"holz", wood, -1},
    {"aste", wood, -1, alone},
    {"aeste", wood, -1, alone},
    {"ast", wood, -1, alone},
    {"zweig", wood, -0.6},
    {"trank", wood, -1, alone},
    {"broun", wood, -0.5, alone},
    {"wurzel", wood, -1},
    {"schors", wood, -1},
    {"hout", wood, -1, alone},
    {"takken", wood, -1, alone},
    {"stam", wood, -1, alone},
    {"kvist", wood, -1},
    {"ecorce", wood, -1},
    {"tronc", wood, -1},
    {"bois", wood, -1, alone},
    {"tige", wood, -1, alone},
    {"racine", wood, -1},
    {"corteza", wood, -1},
    {"madera", wood, -1},
    {"rama", wood, -1, alone},
    {"ramas", wood, -1, alone},
    {"tallo", wood, -1, alone},
    {"casca", wood, -1, alone},
    {"madeira", wood, -1},
    {"galho", wood, -1},
    {"caule", wood, -1, alone},
    {"corteccia", wood, -1},
    {"legno", wood, -1},
    {"ramo", wood, -1, alone},
    {"rami", wood, -1, alone},
    {"fusto", wood, -1, alone},
    {"kora", wood, -1, alone},
    {"pien", wood, -1, alone},
    {"drewno", wood, -1},
    {"galaz", wood, -1},
    {"govde", wood, -1},
    {"kabuk", wood, -1, alone},
    {"kaarna", wood, -1},
    {"runko", wood, -1, alone},
    {"oksa", wood, -1, alone},
    {"batang", wood, -1},
    {"stvol", wood, -1},
    {"кора", wood, -1},
    {"ствол", wood, -1},
    {"стебел", wood, -1},
    {"древ", wood, -1},
    {"ветк", wood, -1},
    {"ветв", wood, -1},
    {"φλοι", wood, -1},
    {"κορμ", wood, -1},
    {"树皮", wood, -1},
    {"樹皮", wood, -1},
    {"树干", wood, -1},
    {"樹幹", wood, -1},
    {"幹", wood, -1},
    {"枝", wood, -1},
    {"木头", wood, -1},
    {"木材", wood, -1},
    {"줄기", wood, -1},
    {"가지", wood, -1},
    {"껍질", wood, -1},
    {"brown", wood, -0.5},
    {"braun", wood, -0.5},
    {"marron", wood, -0.5},
    {"brun", wood, -0.5, alone},
    {"коричнев", wood, -0.5},
    {"grey", wood, -0.3, alone},
    {"gray", wood, -0.3, alone},

    // What else stands about a tree, and hangs on it.
    {"ground", other, -1},
    {"soil", other, -1},
    {"dirt", other, -1},
    {"terrain", other, -1},
    {"landscape", other, -1},
    {"floor", other, -1},
    {"earth", other, -1, alone},
    {"sand", other, -1, alone},
    {"mud", other, -1, alone},
    {"rock", other, -1},
    {"stone", other, -1},
    {"boulder", other, -1},
    {"cliff", other, -1},
    {"water", other, -1},
    {"lake", other, -1, alone},
    {"pond", other, -1, alone},
    {"river", other, -1, alone},
    {"ocean", other, -1},
    {"pot", other, -1, alone},
    {"planter", other, -1},
    {"flowerpot", other, -1},
    {"vase", other, -1, alone},
    {"fence", other, -1},
    {"house", other, -1},
    {"roof", other, -1, alone},
    {"wall", other, -1, alone},
    {"spiderweb", other, -1},
    {"web", other, -1, alone},
    {"webs", other, -1, alone},
    {"snow", other, -0.7, alone},
    {"fruit", other, -1},
    {"apple", other, -0.7, alone},
    {"apples", other, -0.7, alone},
    {"berry", other, -0.7, alone},
    {"berries", other, -0.7, alone},
    {"acorn", other, -1},
    {"mushroom", other, -1},
    {"moss", other, -0.7, alone},
    {"ucx", other, -1, alone},  // Unreal's collision hulls
    {"ubx", other, -1, alone},
    {"collision", other, -1},
    {"collider", other, -1},
    {"skybox", other, -1},
    {"boden", other, -1, alone},
    {"erde", other, -1, alone},
    {"stein", other, -1, alone},
    {"wasser", other, -1},
    {"zemin", other, -1, alone},
    {"zaun", other, -1, alone},
    {"topf", other, -1},
    {"terre", other, -1, alone},
    {"roche", other, -1},
    {"pierre", other, -1, alone},
    {"eau", other, -1, alone},
    {"suelo", other, -1},
    {"tierra", other, -1},
    {"piedra", other, -1},
    {"roca", other, -1, alone},
    {"agua", other, -1, alone},
    {"maceta", other, -1},
    {"solo", other, -1, alone},
    {"chao", other, -1, alone},
    {"terra", other, -1, alone},
    {"pedra", other, -1},
    {"terreno", other, -1},
    {"pietra", other, -1},
    {"roccia", other, -1},
    {"acqua", other, -1},
    {"vaso", other, -1, alone},
    {"земля", other, -1},
    {"камен", other, -1},
    {"вода", other, -1},
    {"забор", other, -1},
    {"горшок", other, -1},
    {"地面", other, -1},
    {"土", other, -1},
    {"石", other, -1},
    {"岩", other, -1},
    {"水", other, -1},
    {"盆", other, -1},
    {"鉢", other, -1},
});

/// U+00C0 to U+017F without their accents, in lower case; '?' stays as it is.
constexpr std::string_view kPlain =
    "aaaaaaaceeeeiiiidnooooo?ouuuuyts"
    "aaaaaaaceeeeiiiidnooooo?ouuuuyty"
    "aaaaaaccccccccddddeeeeeeeeeegggg"
    "gggghhhhiiiiiiiiiiiijjkkklllllll"
    "lllnnnnnnnnnoooooooorrrrrrssssss"
    "ssttttttuuuuuuuuuuuuwwyyyzzzzzzs";

/// Removes the next code point from `text` and returns it; a byte that is not UTF-8 stands for
/// itself.
std::uint32_t take_code(std::string_view& text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  const std::size_t length = first < 0xC2 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  std::uint32_t code = length == 1 ? first : first & (0xFFu >> (length + 1));
  std::size_t taken = 1;
  for (; taken < length && taken < text.size() && (byte(taken) & 0xC0) == 0x80; ++taken) {
    code = code << 6 | (byte(taken) & 0x3Fu);
  }
  if (taken < length) {
    code = first;
    taken = 1;
  }
  text.remove_prefix(taken);
  return code;
}

void put_code(std::uint32_t code, std::string& text) {
  const auto put = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
  if (code < 0x80) return put(code);
  if (code < 0x800) {
    put(0xC0 | code >> 6);
  } else if (code < 0x10000) {
    put(0xE0 | code >> 12);
    put(0x80 | (code >> 6 & 0x3F));
  } else {
    put(0xF0 | code >> 18);
    put(0x80 | (code >> 12 & 0x3F));
    put(0x80 | (code >> 6 & 0x3F));
  }
  put(0x80 | (code & 0x3F));
}

bool is_upper(std::uint32_t c) {
  if (c >= 0x100 && c < 0x180) return (c % 2 == 1) == (c >= 0x139 && c <= 0x148);
  return (c >= 'A' && c <= 'Z') || (c >= 0xC0 && c <= 0xDE) || (c >= 0x410 && c <= 0x42F);
}
bool is_digit(std::uint32_t c) { return c >= '0' && c <= '9'; }

/// The letter in lower case without accent; a blank for other characters, 0 for a lone accent.
std::uint32_t fold(std::uint32_t c) {
  if (c >= 'A' && c <= 'Z') return c + 32;
  if (is_digit(c) || c < 0x80) return (c >= 'a' && c <= 'z') || is_digit(c) ? c : ' ';
  if (c >= 0xC0 && c < 0x180) {
    const char plain = kPlain[c - 0xC0];
    return plain == '?' ? ' ' : static_cast<unsigned char>(plain);
  }
  if (c >= 0x300 && c < 0x370) return 0;
  if (c == 0x401 || c == 0x451) return 0x435;  // Russian yo
  if (c >= 0x410 && c <= 0x42F) return c + 32;
  if (c >= 0x391 && c <= 0x3A9) return c + 32;
  constexpr std::array<std::uint32_t, 12> kGreek{0x3AC, 0x3B1, 0x3AD, 0x3B5, 0x3AE, 0x3B7,
                                                 0x3AF, 0x3B9, 0x3CC, 0x3BF, 0x3CD, 0x3C5};
  for (std::size_t i = 0; i < kGreek.size(); i += 2) {
    if (c == kGreek[i]) return kGreek[i + 1];
  }
  return c;
}

struct Match {
  const Word* word = nullptr;
  std::size_t begin = 0, end = 0;
};

/// Whether a match in the folded name is bounded by blanks.
bool is_alone(std::string_view name, const Match& match) {
  return (match.begin == 0 || name[match.begin - 1] == ' ') &&
         (match.end == name.size() || name[match.end] == ' ');
}

/// The words found in the name, in order, without those inside a longer one.
std::vector<Match> matches_in(std::string_view name) {
  std::vector<Match> matches;
  for (const Word& word : kWords) {
    for (auto at = name.find(word.text); at != name.npos; at = name.find(word.text, at + 1)) {
      const Match match{&word, at, at + word.text.size()};
      if (word.stands == alone && !is_alone(name, match)) continue;
      const auto covers = [&](const Match& m) {
        return m.begin < match.end && match.begin < m.end;
      };
      const auto other = std::ranges::find_if(matches, covers);
      if (other == matches.end()) {
        matches.push_back(match);
      } else if (match.end - match.begin > other->end - other->begin) {
        *other = match;
      }
    }
  }
  std::ranges::sort(matches, {}, &Match::begin);
  return matches;
}

}  // namespace

std::string folded(std::string_view name) {
  std::string text;
  std::uint32_t before = ' ';
  while (!name.empty()) {
    const std::uint32_t code = take_code(name);
    const std::uint32_t letter = fold(code);
    if (letter == 0) continue;
    const bool new_word =
        (is_upper(code) && !is_upper(before)) || is_digit(code) != is_digit(before);
    if (new_word && !text.empty() && text.back() != ' ') text += ' ';
    if (letter != ' ' || (!text.empty() && text.back() != ' ')) put_code(letter, text);
    before = code;
  }
  return text;
}

NameSign read_name(std::string_view name) {
  const std::string text = folded(name);
  const std::vector<Match> matches = matches_in(text);
  NameSign sign;
  double against = 0;
  for (const Match& match : matches) {
    const Word& word = *match.word;
    if (word.growth == unknown) continue;
    if (sign.weight * word.weight < 0) against = std::max(against, std::abs(sign.weight));
    // A colour takes nothing away from the thing that has it.
    if (std::abs(word.weight) < std::abs(sign.weight) && std::abs(word.weight) <= 0.5) continue;
    sign = {word.weight, word.growth, std::string(word.text)};
  }
  if (against > 0) sign.weight *= 1 - against / 2;
  return sign;
}

}  // namespace leafhull
