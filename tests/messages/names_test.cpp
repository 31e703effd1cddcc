// Text from files, logs and the network is displayed, never interpreted as control characters.
#include "messages/names.h"

#include <gtest/gtest.h>

#include "messages/csv_cell.h"

namespace whirl_twin {
namespace names_test {

TEST(Printable, TextIsShownAsItIs) {
  for (const char* text : {"rotor", "k = 2e4 N/m", "\u03c9\u00b2 \u2212 p\u00b2", "\U0001f300"}) {
    EXPECT_EQ(printable(text), text);
  }
}

TEST(Printable, WhatATerminalObeysIsShownEscaped) {
  EXPECT_EQ(printable("x\x1b[2J\x1b[31mred\nnext\r\t\x7f"),
            R"(x\x1b[2J\x1b[31mred\x0anext\x0d\x09\x7f)");
  EXPECT_EQ(printable(std::string("a\0b", 3)), R"(a\x00b)");
  // C1 controls, which begin a command like ESC [ does; a mark that reverses the text direction.
  EXPECT_EQ(printable("a\u009b2Jb"), R"(a\xc2\x9b2Jb)");
  EXPECT_EQ(printable("a\u202eb\u2066c\u2028d"), R"(a\xe2\x80\xaeb\xe2\x81\xa6c\xe2\x80\xa8d)");
}

TEST(Printable, WhatIsNoUtf8IsNot) {
  EXPECT_EQ(printable("caf\xe9 \x9b"), R"(caf\xe9 \x9b)");
  EXPECT_EQ(printable("\xc0\x9b|\xe0\x80\x9b|\xed\xa0\x80|\xf4\x90\x80\x80|\xe2\x82"),
            R"(\xc0\x9b|\xe0\x80\x9b|\xed\xa0\x80|\xf4\x90\x80\x80|\xe2\x82)");
}

TEST(Printable, IsCutBetweenCharacters) {
  const std::string long_text = std::string(kMaxShown - 1, 'a') + "\u00e9 and more";
  EXPECT_EQ(printable(long_text), std::string(kMaxShown - 1, 'a') + "...");
  EXPECT_EQ(printable(std::string(kMaxShown, 'a')), std::string(kMaxShown, 'a'));
  EXPECT_EQ(printable("abcdef", 3), "abc...");
}

TEST(PrintableLines, KeepsLinesAndTabs) {
  EXPECT_EQ(printableLines("a\tb\n\x1b[1mc\r\n"), "a\tb\n\\x1b[1mc\\x0d\n");
  EXPECT_EQ(printableLines(std::string(200, 'a')), std::string(200, 'a'));
}

// RFC 4180; what a spreadsheet computes as OWASP lists it ("CSV injection").
TEST(CsvCell, IsOneCellOfTextThatNothingComputes) {
  EXPECT_EQ(csvCell("rotor"), "rotor");
  EXPECT_EQ(csvCell("a, \"b\""), "\"a, \"\"b\"\"\"");
  for (const char* text : {"=1+1", "+1+1", "-2+3", "@SUM(A1)", "=HYPERLINK(x)"}) {
    EXPECT_EQ(csvCell(text), std::string("'") + text);
  }
  EXPECT_EQ(csvCell("=1,2"), "\"'=1,2\"");
  EXPECT_EQ(csvCell("\t=1+1"), "'\\x09=1+1");
  EXPECT_EQ(csvCell("-"), "-");
  EXPECT_EQ(csvCell("two\r\nlines"), "two\\x0d\\x0alines");
}

}  // namespace names_test
}  // namespace whirl_twin
