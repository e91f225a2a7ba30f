// SPDX-License-Identifier: MIT
// Nothing: the target that this file stands for holds the headers that are compiled once for all tests.
