// SPDX-License-Identifier: MIT

/// Assimp 5.2 forgets what it has read of an STL file when it finds an error in it. Called by LeakSanitizer.
extern "C" const char* __lsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier): the name it looks for
extern "C" const char* __lsan_default_suppressions() { return "leak:libassimp\n"; }
