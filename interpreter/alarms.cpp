#include "interpreter/alarms.h"

#include <algorithm>

namespace trunnion::interpreter {
namespace {

constexpr AlarmInfo table[] = {
    {3, "TOO MANY DIGIT", "a number has more digits than the control reads", "shorten the number"},
    {4, "INVALID BREAK POINT OF WORDS", "a number stands without an address",
     "write the address letter before the number"},
    {5, "NO DATA AFTER ADDRESS", "an address has no value", "write a number, #n or [..] behind it"},
    {6, "ILLEGAL USE OF MINUS SIGN", "a sign stands where none may, or stands twice",
     "remove the sign"},
    {7, "ILLEGAL USE OF DECIMAL POINT", "a point where none may stand, or a second one",
     "correct the number"},
    {9, "IMPROPER NC-ADDRESS", "a character that is no part of the language",
     "remove the character or put the text into a comment"},
    {76, "PROGRAM NOT FOUND", "the called program does not exist",
     "correct the program number or load the program"},
    {77, "TOO MANY SUB,MACRO NESTING", "too many calls inside each other", "call less deeply"},
    {78, "SEQUENCE NUMBER NOT FOUND", "the block that M98 Q or M99 P names does not exist",
     "correct the number"},
    {110, "OVERFLOW :INTEGER", "a whole number is too large", "correct the value"},
    {111, "OVERFLOW :FLOATING", "a result is too large", "correct the expression"},
    {112, "ZERO DIVIDE", "division by zero", "guard the division"},
    {114, "ILLEGAL EXPRESSION FORMAT", "an expression is not written as the control reads it",
     "correct the expression"},
    {115, "VARIABLE NO. OUT OF RANGE", "there is no variable with this number",
     "correct the variable number"},
    {116, "WRITE PROTECTED VARIABLE", "this variable can only be read", "remove the assignment"},
    {118, "TOO MANY BRACKET NESTING", "more than five brackets inside each other",
     "split the expression"},
    {119, "ARGUMENT VALUE OUT OF RANGE", "a function has no value for this argument",
     "guard the argument"},
    {122, "TOO MANY MACRO NESTING", "too many macro calls inside each other", "call less deeply"},
    {124, "MISSING END STATEMENT", "a DO has no END of its number", "write the END"},
    {125, "MACRO STATEMENT FORMAT ERROR",
     "a macro statement is not written as the control reads it", "correct the statement"},
    {126, "ILLEGAL LOOP NUMBER", "DO and END take the numbers 1 to 3", "use 1, 2 or 3"},
    {127, "DUPLICATE NC,MACRO STATEMENT", "NC words and a macro statement in one block",
     "write two blocks"},
    {128, "ILLEGAL MACRO SEQUENCE NUMBER", "the block that GOTO names does not exist",
     "correct the number or write the N"},
    {129, "USE 'G' AS ARGUMENT", "G, L, N, O or P cannot pass an argument", "use another letter"},
    {1090, "PROGRAM FORMAT ERROR", "the block is not written as the control reads it",
     "correct the block"},
    {1095, "TOO MANY TYPE-2 ARGUMENT", "more than ten sets of I, J, K", "pass fewer arguments"},
    {1096, "ILLEGAL VARIABLE NAME", "a variable name that SETVN did not give", "correct the name"},
    {1124, "MISSING DO STATEMENT", "an END has no DO of its number that is running",
     "write the DO, and do not jump into loops"},
    {1131, "MISSING OPEN BRACKET", "a '[' is missing", "write the bracket"},
    {1132, "MISSING CLOSE BRACKET", "a ']' is missing", "write the bracket"},
    {1133, "MISSING '='", "an assignment has no '='", "write the '='"},
    {1134, "MISSING ','", "a function lacks its second argument", "write both arguments"},
    {1137, "IF STATEMENT FORMAT ERROR", "behind IF [..] neither GOTO n nor THEN with an assignment",
     "write IF [..] GOTO n, or IF [..] THEN #n = .. in one block"},
    {1138, "WHILE STATEMENT FORMAT ERROR", "behind WHILE [..] no DO 1 to 3",
     "write WHILE [..] DO n"},
    {1139, "SETVN STATEMENT FORMAT ERROR", "SETVN is not written SETVN n [NAME,NAME]",
     "correct the statement"},
    {1143, "BPRNT/DPRNT STATEMENT FORMAT ERROR", "the print statement cannot be read",
     "write DPRNT [text #n [ab] ..]"},
    {1144, "G10 FORMAT ERROR", "the data of G10 cannot be read", "correct the block"},
};

}  // namespace

std::span<const AlarmInfo> language_alarms() {
    return table;
}

const AlarmInfo* language_alarm(int number) {
    const auto* row = std::lower_bound(std::begin(table), std::end(table), number,
                                       [](const AlarmInfo& a, int n) { return a.number < n; });
    return row != std::end(table) && row->number == number ? row : nullptr;
}

void raise_language_alarm(int number, int column, const std::string& detail) {
    const AlarmInfo* row = language_alarm(number);
    std::string text = row ? row->text : "ALARM";
    if (!detail.empty()) text += ": " + detail;
    SourceRef where;
    where.column = column;
    throw Alarm(number, text, where);
}

}  // namespace trunnion::interpreter
