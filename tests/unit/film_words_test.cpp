// Parts of `bihive film`: the words of a codec that stand in a file, the index of a sequence, and lists of pictures.
// ctest: needs bihive_commands
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "bihive/base/fnv.h"
#include "film/codec_words.h"
#include "film/content_hash.h"
#include "film/picture_index.h"
#include "film/picture_numbers.h"
#include "film/picture_order.h"

namespace bihive::cli {
namespace {

TEST(CodecWords, AreSplitAtSpaces) {
  EXPECT_EQ(codec_words("  -c:v  libx265 -crf 20 "), (std::vector<std::string>{"-c:v", "libx265", "-crf", "20"}));
  EXPECT_TRUE(codec_words("").empty());
}

TEST(CodecWords, OfAFileChooseCodecAndQuality) {
  for (const char* const text :
       {"", "-c:v libx265 -crf 20", "-c:v libvpx-vp9 -crf 24 -b:v 0 -row-mt 1", "-b:v 2.5M -bf -1",
        "-c:v ffv1 -pix_fmt gbrp", "-c:v libx264 -preset slow -tune film -movflags +faststart"})
    EXPECT_TRUE(check_codec_of_file(text)) << text;
}

TEST(CodecWords, OfAFileDoNothingElse) {
  for (const char* const text : {"-i file",
                                 "-f image2",
                                 "other.mp4",
                                 "-y",
                                 "-c:v",
                                 "-c:v -y",
                                 "-crf 20 other.mp4",
                                 "-c:v libx264 -vf movie=x",
                                 "-filter_complex movie=x",
                                 "-attach x",
                                 "-x264-params csv=x",
                                 "-pass 1",
                                 "-passlogfile x",
                                 "-c:v ../x",
                                 "-crf /etc/x",
                                 "-crf pipe:1",
                                 "-crf http://x",
                                 "-crf a=b",
                                 "-crf %d",
                                 "-crf @x",
                                 "-report",
                                 "-progress x",
                                 "-c:v x\n-y",
                                 "-crf 11111111111111111111111111111111111111111",
                                 "--crf 1",
                                 "-",
                                 "-c 1",
                                 "-vstats_file x",
                                 "-dump_attachment:t x"})
    EXPECT_FALSE(check_codec_of_file(text)) << text;
}

TEST(CodecOfFile, ErrorsShowNoControlCharacters) {
  EXPECT_THAT(check_codec_of_file("-b:v \x01\x1b[2J").error().message, testing::HasSubstr("-b:v ??[2J"));
}

TEST(PictureIndex, HoldsWhatWasWritten) {
  const IndexEntry one{0, 120, fnv1a("one")}, two{7, 99, fnv1a("two")};
  const std::string text = index_head(5) + index_line(one) + index_line(two);
  const auto index = read_index(text, 5);
  ASSERT_TRUE(index);
  EXPECT_EQ(index->own, (std::vector<IndexEntry>{one, two}));
  EXPECT_TRUE(index->earlier.empty() && index->ends_with_own);
  EXPECT_EQ(whole_lines(text), text.size());
}

TEST(PictureIndex, KnowsThePicturesOfOtherFilms) {
  const IndexEntry one{0, 120, fnv1a("one")}, two{7, 99, fnv1a("two")}, three{0, 1, fnv1a("three")};
  const std::string first = index_head(5) + index_line(one), text = first + index_head(6) + index_line(two);
  for (const auto& [whole, film] : {std::pair(text, 6), std::pair(text, 5), std::pair(text, 4)}) {
    const auto index = read_index(whole, static_cast<std::uint64_t>(film));
    ASSERT_TRUE(index);
    EXPECT_EQ(index->own.size(), film == 4 ? 0u : 1u) << film;
    EXPECT_EQ(index->earlier.size(), film == 4 ? 2u : 1u) << film;
    EXPECT_EQ(index->ends_with_own, film == 6) << film;
  }
  // The first film again.
  const auto again = read_index(text + index_head(5) + index_line(three), 5);
  EXPECT_EQ(again->own, (std::vector<IndexEntry>{one, three}));
  EXPECT_EQ(again->earlier, (std::vector<IndexEntry>{two}));
  EXPECT_TRUE(again->ends_with_own);
}

TEST(PictureIndex, IsNoOtherFile) {
  for (const char* const text : {"hello", "hello\n", "bihive film Index 1 ", "\n"})
    EXPECT_FALSE(read_index(text, 5)) << text;
}

TEST(PictureIndex, LosesAtMostTheLineThatAKillHasCut) {
  const IndexEntry one{0, 120, fnv1a("one")}, two{12345678, 99, fnv1a("two")};
  const std::string first = index_head(5) + index_line(one), text = first + index_line(two);
  for (std::size_t size = 0; size < text.size(); ++size) {
    const std::string cut = text.substr(0, size);
    const auto index = read_index(cut, 5);
    ASSERT_TRUE(index) << size;
    EXPECT_EQ(index->own.size(), size >= first.size() ? 1u : 0u) << size;
    EXPECT_EQ(index->ends_with_own, size >= index_head(5).size()) << size;
    // Even where a later run adds lines after it without cutting it off.
    const auto later = read_index(cut + "\n" + index_line(two), 5);
    if (!later) continue;
    for (const IndexEntry& entry : later->own) EXPECT_TRUE(entry == one || entry == two) << size;
  }
}

TEST(PictureIndex, TakesNoLineThatIsNone) {
  const std::string hash = "0123456789abcdef";
  for (const std::string& line :
       std::vector<std::string>{"1 2", "1 2 " + hash + "0", "1 2 " + hash.substr(1), "-1 2 " + hash, "1 -2 " + hash,
                                "a 2 " + hash, "1 2  " + hash, " 1 2 " + hash, "1 2 0123456789ABCDEF",
                                "9999999999999999999 2 " + hash, "1 2 " + hash + "\r", std::string()}) {
    const auto index = read_index(index_head(1) + line + "\n", 1);
    ASSERT_TRUE(index);
    EXPECT_TRUE(index->own.empty()) << line;
  }
}

TEST(PictureIndex, HasANameForEachShard) {
  EXPECT_EQ(index_name("", 0, 1), "film.index");
  EXPECT_EQ(index_name("p", 3, 16), "pfilm.3-16.index");
  for (const char* const name : {"pfilm.index", "pfilm.3-16.index"}) EXPECT_TRUE(is_index_name("p", name)) << name;
  for (const char* const name : {"film.index", "pfilm.json", "pfilm.3.index", "pfilm.3-16index", "pfilm.x-y.index",
                                 "pfilm.-.index", "pfilm..index", "pfilm.3-16.index.x"})
    EXPECT_FALSE(is_index_name("p", name)) << name;
}

std::vector<std::int64_t> listed(const PictureNumbers& numbers) {
  std::vector<std::int64_t> all;
  for (const std::int64_t number : numbers) all.push_back(number);
  return all;
}

using Numbers = std::vector<std::int64_t>;

Numbers shown(const PictureOrder& order, std::int64_t pictures) {
  Numbers all;
  for (std::int64_t k = 0; k < order.positions(pictures); ++k) all.push_back(order.picture_at(k, pictures));
  return all;
}

TEST(PictureOrder, IsThatOfTheOptions) {
  EXPECT_TRUE(PictureOrder().is_plain());
  EXPECT_EQ(shown({}, 4), (Numbers{0, 1, 2, 3}));
  EXPECT_EQ(shown({2, 0, false, false}, 3), (Numbers{0, 0, 0, 1, 2}));
  EXPECT_EQ(shown({0, 2, false, false}, 3), (Numbers{0, 1, 2, 2, 2}));
  EXPECT_EQ(shown({0, 0, true, false}, 3), (Numbers{2, 1, 0}));
  EXPECT_EQ(shown({1, 2, true, false}, 3), (Numbers{2, 2, 1, 0, 0, 0}));
  EXPECT_EQ(shown({0, 0, false, true}, 4), (Numbers{0, 1, 2, 3, 2, 1}));
  EXPECT_EQ(shown({1, 1, false, true}, 4), (Numbers{0, 0, 1, 2, 3, 3, 2, 1}));
  EXPECT_EQ(shown({1, 1, true, true}, 3), (Numbers{2, 2, 1, 0, 0, 1}));
  EXPECT_EQ(shown({0, 0, true, true}, 2), (Numbers{1, 0}));
  EXPECT_EQ(shown({1, 2, true, true}, 1), (Numbers{0, 0, 0, 0}));
}

TEST(PictureOrder, KnowsWhereEachPictureIsShownFirst) {
  for (std::int64_t pictures = 1; pictures < 6; ++pictures)
    for (int options = 0; options < 36; ++options) {
      const PictureOrder order{options % 3, options / 3 % 3, options / 9 % 2 == 1, options / 18 == 1};
      const Numbers all = shown(order, pictures);
      EXPECT_LE(order.positions_forth(pictures), order.positions(pictures));
      std::int64_t drawn = 0;
      for (std::size_t k = 0; k < all.size(); ++k) {
        const auto first = std::find(all.begin(), all.end(), all[k]) - all.begin();
        EXPECT_EQ(order.first_position(static_cast<std::int64_t>(k), pictures), first) << options << " " << pictures;
        drawn += first == static_cast<std::ptrdiff_t>(k) ? 1 : 0;
      }
      EXPECT_EQ(drawn, pictures) << options;
    }
}

TEST(PictureNumbers, OfAFilmTakeNoMoreMemoryThanOne) {
  const PictureNumbers all = PictureNumbers::every(1, 0, 100'000'000);
  EXPECT_EQ(all.size(), 100'000'000);
  EXPECT_EQ(all.runs().size(), 1u);
  EXPECT_TRUE(all.contains(0) && all.contains(99'999'999));
  EXPECT_FALSE(all.contains(-1) || all.contains(100'000'000));

  PictureNumbers drawn(3);
  for (std::int64_t k = 2; k < 300'000; k += 3) drawn.add(k);
  EXPECT_EQ(drawn.size(), 100'000);
  EXPECT_EQ(drawn.runs().size(), 1u);
}

TEST(PictureNumbers, OfAShard) {
  EXPECT_EQ(listed(PictureNumbers::every(3, 1, 11)), (std::vector<std::int64_t>{1, 4, 7, 10}));
  EXPECT_EQ(listed(PictureNumbers::every(3, 1, 10)), (std::vector<std::int64_t>{1, 4, 7}));
  EXPECT_EQ(listed(PictureNumbers::every(3, 1, 2)), (std::vector<std::int64_t>{1}));
  EXPECT_TRUE(PictureNumbers::every(3, 1, 1).empty());
  EXPECT_TRUE(listed(PictureNumbers(3)).empty());
}

TEST(PictureNumbers, WithGaps) {
  const std::vector<std::int64_t> some{0, 2, 4, 5, 7, 20, 22};
  PictureNumbers numbers(2);
  for (const std::int64_t number : some) numbers.add(number);
  EXPECT_EQ(numbers.size(), 7);
  EXPECT_EQ(listed(numbers), some);
  EXPECT_EQ(listed(PictureNumbers(2, numbers.runs())), some) << "as another rank gets them";
  for (std::int64_t k = -1; k < 25; ++k)
    EXPECT_EQ(numbers.contains(k), std::find(some.begin(), some.end(), k) != some.end()) << k;
}

}  // namespace
}  // namespace bihive::cli
