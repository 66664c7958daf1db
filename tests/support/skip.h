#pragma once

#include <string>

namespace mspskel::test {
// Marks this test process as skipped; return from the test case right after it.
void skip(const std::string& why);
}  // namespace mspskel::test
