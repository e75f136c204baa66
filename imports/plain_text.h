// The text of a file with the plain signs that numbers and names are read with.
#pragma once

#include <string>

namespace trunnion::imports {

/// UTF-8 (a file in Windows-1252, as spreadsheets save it, is converted), with `-` for the minus
/// sign U+2212 and every dash, and a blank for one that does not break a line.
std::string plain_text(std::string text);

}  // namespace trunnion::imports
