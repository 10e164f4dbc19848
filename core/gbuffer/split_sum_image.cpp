#include "core/gbuffer/split_sum_image.h"

#include "core/split_sum.h"

Image SplitSumImage::on(PassList& pass_list) {
    const HostImage& table = default_split_sum_table();
    const Image image = pass_list.image_of("split_sum", Format::rg32f, table.extent);
    if (uploaded_.lock() != image.storage) {
        pass_list.upload(image, table);
        uploaded_ = image.storage;
    }
    return image;
}
