// Reads OBJ text number by number, with line numbers for messages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace paim {

// The text for a message: at most 40 characters, with '?' for control characters and non-ASCII
// bytes.
std::string printable(std::string_view text);

// A cursor over OBJ text. It also rewrites the text in place, so that a less careful parser reads
// the same: it joins continued lines and blanks comments at the ends of lines, with spaces, so that
// no byte moves.
class ObjText {
  public:
    // name  of the file, for messages; must outlive the cursor
    ObjText(const std::string& name, std::span<char> text);

    bool at_end() const { return at_ == end_; }
    size_t line() const { return line_; }  // counted from 1

    // The first word of the line (up to a space), or nothing on an empty line. Leading space is
    // skipped.
    std::string_view read_keyword();
    // Turns the line whose keyword was just read into a comment.
    void comment_out_line() { *keyword_ = '#'; }
    // Blanks the rest of the line.
    void blank_rest_of_line();
    // The rest of the line, without space at either end.
    std::string_view read_rest_of_line();
    void next_line();

    // Skips space and continued line ends. Returns true if another word follows on this line.
    bool find_word();
    // Skips a finite decimal number within float's range that fills the whole word. Numbers far too
    // small for float become 0 in the text.
    // Error (bad input) if the word is anything else.
    // what  names the number in the message
    void skip_number(const char* what);
    // The same; returns the number as a double.
    double read_number(const char* what);
    // Reads an integer up to the end of its digits. Returns false if it exceeds 64 bits; its digits
    // are skipped then. Error (bad input), naming `what`, if there is none.
    bool read_integer(const char* what, int64_t& value);
    // Skips one character if it is `c`.
    bool skip(char c);
    bool at_word_end() const;
    // The whole word that contains the character before the cursor or at it.
    std::string_view word_from(const char* start) const;
    const char* position() const { return at_; }

    // Error (bad input): "name:line: message".
    [[noreturn]] void fail(std::string_view message) const;

  private:
    bool at_line_end() const { return at_ == end_ || *at_ == '\n' || *at_ == '\r'; }
    // Number of bytes of a backslash and the line end after it; 0 if there are none.
    size_t continuation_size(const char* at) const;
    void skip_unusual_number(char* start, const char* what);

    const std::string& name_;
    char* at_;
    char* end_;
    char* keyword_ = nullptr;
    size_t line_ = 1;
};

}  // namespace paim
