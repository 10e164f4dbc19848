#include "core/gbuffer/split_sum_image.h"

#include "core/split_sum.h"

Image SplitSumImage::on(PassGraph& graph) {
    const HostImage& table = default_split_sum_table();
    const Image image = graph.image_of("split_sum", Format::rg32f, table.extent);
    if (uploaded_.lock() != image.storage) {
        graph.upload(image, table);
        uploaded_ = image.storage;
    }
    return image;
}
