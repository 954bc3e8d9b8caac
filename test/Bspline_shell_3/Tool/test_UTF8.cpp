#include <Files/UTF8.h>

#include <catch2/catch.hpp>

#include <string>

namespace test_UTF8 {

using namespace Tool;

TEST_CASE("UTF8: texts in UTF-8 remain")
{
  for(const char* text : { "", "plain", "gr\xC3\xBCn", "\xE2\x82\xAC", "\xF0\x9F\x90\x98", "\xED\x9F\xBF\xEE\x80\x80" })
    CHECK(to_UTF8(text) == text);
}

TEST_CASE("UTF8: other bytes become characters of Latin-1")
{
  CHECK(to_UTF8("gr\xFCn") == "gr\xC3\xBCn");
  CHECK(to_UTF8("\xE9") == "\xC3\xA9");
  CHECK(to_UTF8("\x80") == "\xC2\x80");
  CHECK(to_UTF8("\xC3\xBC\xFC") == "\xC3\xBC\xC3\xBC");
}

TEST_CASE("UTF8: forms that the standard forbids are not UTF-8")
{
  // Longer forms than necessary, surrogates, numbers that are too large, and incomplete characters
  for(const char* text : { "\xC0\x80", "\xE0\x80\x80", "\xED\xA0\x80", "\xF0\x80\x80\x80", "\xF4\x90\x80\x80", "\xF5",
                           "\xE2\x82", "\xC3" })
    CHECK(UTF8_size(text) == 0);
}

} // namespace test_UTF8
