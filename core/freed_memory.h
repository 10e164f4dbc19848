#pragma once

/// Keeps what is freed in the process, for whoever asks next. By glibc's defaults large blocks go back to the system
/// and are asked for again, page by page. A page that is touched for the first time costs more than most work on its
/// 4 KiB: the tests of ghost_share took four times as long.
void keep_freed_memory();
