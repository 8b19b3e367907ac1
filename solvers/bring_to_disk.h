// Files that must outlive a power cut.
#pragma once

#include <filesystem>

namespace sluice {

/// Returns when what was written to a file, or renamed within a folder, is on the disk. What has no disk behind it (a
/// device, a pipe) is left alone. Throws std::runtime_error that names it when the disk refuses.
void bring_to_disk(const std::filesystem::path& file_or_folder);

}  // namespace sluice
