// A Vulkan layer for programs that present nothing, whose frames RenderDoc cannot separate: the capture lasts from
// the creation of a device to its end. run.sh uses it.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <renderdoc_app.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <vulkan/vk_layer.h>

static PFN_vkGetInstanceProcAddr next_instance_proc;
static PFN_vkGetDeviceProcAddr next_device_proc;
static PFN_vkDestroyDevice next_destroy_device;
static VkInstance last_instance;  // programs that make several draw with the last
static PFN_vkGetPhysicalDeviceProperties next_properties;
static PFN_vkGetPhysicalDeviceProperties2 next_properties2;
static PFN_vkCreateDevice next_create_device;
static PFN_vkQueueSubmit next_submit;
static PFN_vkQueueSubmit2 next_submit2;

static RENDERDOC_API_1_1_2* renderdoc(void) {
    static RENDERDOC_API_1_1_2* api;
    void* library = dlopen("librenderdoc.so", RTLD_NOW | RTLD_NOLOAD);
    pRENDERDOC_GetAPI get = library ? (pRENDERDOC_GetAPI)dlsym(library, "RENDERDOC_GetAPI") : NULL;
    if (!api && !(get && get(eRENDERDOC_API_Version_1_1_2, (void**)&api)))
        fprintf(stderr, "whole_run: RenderDoc is not loaded: run.sh loads both\n");
    return api;
}

/// The loader's chain information of a function, which names the next layer.
static void* chain_link(const void* create_info, VkStructureType type) {
    const VkLayerInstanceCreateInfo* info = create_info;
    while (info && !(info->sType == type && info->function == VK_LAYER_LINK_INFO)) info = info->pNext;
    return (void*)info;
}

static VkResult create_instance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* allocator,
                                VkInstance* instance) {
    VkLayerInstanceCreateInfo* chain = chain_link(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    if (!chain) return VK_ERROR_INITIALIZATION_FAILED;
    next_instance_proc = chain->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    chain->u.pLayerInfo = chain->u.pLayerInfo->pNext;
    const VkResult result =
        ((PFN_vkCreateInstance)next_instance_proc(NULL, "vkCreateInstance"))(info, allocator, instance);
    if (result != VK_SUCCESS) return result;
    last_instance = *instance;
    // Now, and not when they are called: later the loader answers for the whole chain, this layer included.
    next_properties = (PFN_vkGetPhysicalDeviceProperties)next_instance_proc(*instance, "vkGetPhysicalDeviceProperties");
    next_properties2 =
        (PFN_vkGetPhysicalDeviceProperties2)next_instance_proc(*instance, "vkGetPhysicalDeviceProperties2");
    next_create_device = (PFN_vkCreateDevice)next_instance_proc(*instance, "vkCreateDevice");
    return result;
}

// RenderDoc says 1.2 of drivers that cannot capture device addresses (lavapipe), since 1.3 promises addresses. What
// takes no address of a buffer runs nevertheless.
static void raise_version(VkPhysicalDeviceProperties* properties) {
    if (properties->apiVersion < VK_API_VERSION_1_3) properties->apiVersion = VK_API_VERSION_1_3;
}

static void get_properties(VkPhysicalDevice physical, VkPhysicalDeviceProperties* properties) {
    next_properties(physical, properties);
    raise_version(properties);
}

static void get_properties2(VkPhysicalDevice physical, VkPhysicalDeviceProperties2* properties) {
    next_properties2(physical, properties);
    raise_version(&properties->properties);
}

static VkResult create_device(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                              const VkAllocationCallbacks* allocator, VkDevice* device) {
    VkLayerDeviceCreateInfo* chain = chain_link(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    if (!chain) return VK_ERROR_INITIALIZATION_FAILED;
    next_device_proc = chain->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    chain->u.pLayerInfo = chain->u.pLayerInfo->pNext;
    const VkResult result = next_create_device(physical, info, allocator, device);
    if (result != VK_SUCCESS) return result;
    next_destroy_device = (PFN_vkDestroyDevice)next_device_proc(*device, "vkDestroyDevice");
    next_submit = (PFN_vkQueueSubmit)next_device_proc(*device, "vkQueueSubmit");
    next_submit2 = (PFN_vkQueueSubmit2)next_device_proc(*device, "vkQueueSubmit2");
    return result;
}

// Before that there is no queue, without which RenderDoc cannot start.
static void start_once(void) {
    static int is_started;
    const char* file = getenv("WHOLE_RUN_FILE");
    if (!is_started && renderdoc() && file) renderdoc()->SetCaptureFilePathTemplate(file);
    if (!is_started && renderdoc())
        renderdoc()->StartFrameCapture(RENDERDOC_DEVICEPOINTER_FROM_VKINSTANCE(last_instance), NULL);
    is_started = 1;
}

static VkResult submit(VkQueue queue, uint32_t count, const VkSubmitInfo* infos, VkFence fence) {
    start_once();
    return next_submit(queue, count, infos, fence);
}

static VkResult submit2(VkQueue queue, uint32_t count, const VkSubmitInfo2* infos, VkFence fence) {
    start_once();
    return next_submit2(queue, count, infos, fence);
}

static void destroy_device(VkDevice device, const VkAllocationCallbacks* allocator) {
    if (renderdoc() && !renderdoc()->EndFrameCapture(RENDERDOC_DEVICEPOINTER_FROM_VKINSTANCE(last_instance), NULL))
        fprintf(stderr, "whole_run: the capture failed\n");
    next_destroy_device(device, allocator);
}

static PFN_vkVoidFunction device_proc(VkDevice device, const char* name) {
    if (!strcmp(name, "vkGetDeviceProcAddr")) return (PFN_vkVoidFunction)device_proc;
    if (!strcmp(name, "vkDestroyDevice")) return (PFN_vkVoidFunction)destroy_device;
    if (!strcmp(name, "vkQueueSubmit")) return (PFN_vkVoidFunction)submit;
    if (!strcmp(name, "vkQueueSubmit2")) return (PFN_vkVoidFunction)submit2;
    return next_device_proc(device, name);
}

static PFN_vkVoidFunction instance_proc(VkInstance instance, const char* name) {
    if (!strcmp(name, "vkGetInstanceProcAddr")) return (PFN_vkVoidFunction)instance_proc;
    if (!strcmp(name, "vkCreateInstance")) return (PFN_vkVoidFunction)create_instance;
    if (!strcmp(name, "vkCreateDevice")) return (PFN_vkVoidFunction)create_device;
    if (!strcmp(name, "vkDestroyDevice")) return (PFN_vkVoidFunction)destroy_device;
    if (!strcmp(name, "vkGetDeviceProcAddr")) return (PFN_vkVoidFunction)device_proc;
    if (!strcmp(name, "vkGetPhysicalDeviceProperties")) return (PFN_vkVoidFunction)get_properties;
    if (!strcmp(name, "vkGetPhysicalDeviceProperties2")) return (PFN_vkVoidFunction)get_properties2;
    return next_instance_proc ? next_instance_proc(instance, name) : NULL;
}

VK_LAYER_EXPORT VkResult vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* version) {
    version->loaderLayerInterfaceVersion = 2;
    version->pfnGetInstanceProcAddr = instance_proc;
    version->pfnGetDeviceProcAddr = device_proc;
    version->pfnGetPhysicalDeviceProcAddr = NULL;
    return VK_SUCCESS;
}
