#include "pages.h"

#include <View/Page.h>

#include <catch2/catch.hpp>

#include <string>
#include <vector>

namespace test_Page {

using namespace Tool;

TEST_CASE("Page: bytes are written in base64, with padding")
{
  if(!has_page_scripts()) return; // the program was built without three.js
  Page page;
  page.add("none", "text", "");
  page.add("one", "text", "f");
  page.add("two", "text", "fo");
  page.add("three", "text", "foo");
  page.add("high", std::vector<unsigned char>{ 255, 254, 253 });
  const std::string text = page.HTML("", {});
  CHECK(text.find("data-name=\"none\" data-type=\"text\"></script>") != std::string::npos);
  CHECK(text.find("data-name=\"one\" data-type=\"text\">Zg==</script>") != std::string::npos);
  CHECK(text.find("data-name=\"two\" data-type=\"text\">Zm8=</script>") != std::string::npos);
  CHECK(text.find("data-name=\"three\" data-type=\"text\">Zm9v</script>") != std::string::npos);
  CHECK(text.find("data-name=\"high\" data-type=\"Uint8\">//79</script>") != std::string::npos);
}

TEST_CASE("Page: numbers of all types can be read again")
{
  if(!has_page_scripts()) return;
  const std::vector<float> floats = { 1.5f, -2e-30f };
  const std::vector<double> doubles = { 1e300, 0.1, -3 };
  const std::vector<int> integers = { -7, 1 << 30 };
  Page page;
  page.add("floats", floats);
  page.add("doubles", doubles);
  page.add("integers", integers);
  const std::string text = page.HTML("", {});
  CHECK(array_of<float>(text, "floats") == floats);
  CHECK(array_of<double>(text, "doubles") == doubles);
  CHECK(array_of<int>(text, "integers") == integers);
}

TEST_CASE("Page: titles and reports cannot add elements to the page")
{
  if(!has_page_scripts()) return;
  Page page;
  page.add("x", "text", "", "\"><b>title</b>");
  const std::string text = page.HTML("a <b> & \"c\"", { { "<i>", "</script>" } });
  CHECK(text.find("<title>a &lt;b&gt; &amp; &quot;c&quot;</title>") != std::string::npos);
  CHECK(text.find("<dt>&lt;i&gt;</dt><dd>&lt;/script&gt;</dd>") != std::string::npos);
  CHECK(text.find("data-title=\"&quot;&gt;&lt;b&gt;title&lt;/b&gt;\"") != std::string::npos);
}

TEST_CASE("Page: the license of three.js is in the page, and nothing is loaded from elsewhere")
{
  if(!has_page_scripts()) return;
  const std::string text = Page().HTML("", {});
  CHECK(text.find("The MIT License") != std::string::npos);
  for(const char* loading : { "<script src", "<link rel=\"stylesheet\"", "@import", "@DATA@", "@REPORT@", "@THREE@" })
    CHECK(text.find(loading) == std::string::npos);
}

} // namespace test_Page
